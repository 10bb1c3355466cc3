#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

/// A number for each of kTrainedClasses: a probability or its logarithm.
using ClassScores = std::array<float, kTrainedClasses.size()>;

inline ClassScores operator+(const ClassScores& a, const ClassScores& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// Probabilities that add up to 1, from logarithms of what is proportional to them.
inline ClassScores normalised(const ClassScores& log_scores) {
  const float largest = std::max({log_scores[0], log_scores[1], log_scores[2]});
  ClassScores p{};
  float sum = 0.0F;
  for (std::size_t k = 0; k < p.size(); ++k) sum += p[k] = std::exp(log_scores[k] - largest);
  for (float& value : p) value /= sum;
  return p;
}

}  // namespace roomwise::segment
