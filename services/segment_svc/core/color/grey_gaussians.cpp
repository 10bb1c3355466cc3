#include "services/segment_svc/core/color/grey_gaussians.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace roomwise::segment {
namespace {

struct Mass {
  std::int64_t count = 0;
  double sum = 0.0;
  double mean() const { return sum / static_cast<double>(count); }
};

/// Pixels of the levels [first, last).
Mass mass(const GreyHistogram& histogram, std::size_t first, std::size_t last) {
  Mass total;
  for (std::size_t level = first; level < last; ++level) {
    total.count += histogram[level];
    total.sum += static_cast<double>(level) * static_cast<double>(histogram[level]);
  }
  return total;
}

double mean_square_from(const GreyHistogram& histogram, double centre) {
  double sum = 0.0;
  for (std::size_t level = 0; level < histogram.size(); ++level) {
    const double off = static_cast<double>(level) - centre;
    sum += off * off * static_cast<double>(histogram[level]);
  }
  return sum / static_cast<double>(mass(histogram, 0, histogram.size()).count);
}

}  // namespace

double iterative_threshold(const GreyHistogram& histogram) {
  const Mass all = mass(histogram, 0, histogram.size());
  if (all.count == 0) throw std::invalid_argument("threshold of no pixels");
  double threshold = all.mean();
  // T only moves while a level changes sides, always the same way: 256 steps are enough.
  for (std::size_t step = 0; step < histogram.size(); ++step) {
    const std::size_t first_above = static_cast<std::size_t>(threshold) + 1;
    const Mass not_above = mass(histogram, 0, first_above);
    const Mass above = mass(histogram, first_above, histogram.size());
    if (above.count == 0 || not_above.count == 0) return threshold;
    const double next = 0.5 * (above.mean() + not_above.mean());
    if (next == threshold) return threshold;
    threshold = next;
  }
  return threshold;
}

std::optional<GreyGaussian> grey_statistics(const GreyHistogram& histogram, GreyStatistics how) {
  const Mass all = mass(histogram, 0, histogram.size());
  if (all.count < 2) return std::nullopt;
  const double mean = how == GreyStatistics::kAverage ? all.mean() : iterative_threshold(histogram);
  return GreyGaussian{
      .mean_levels = mean,
      .sigma_levels = std::max(kSigmaMin_levels, std::sqrt(mean_square_from(histogram, mean)))};
}

double log_likelihood(double grey_levels, const GreyGaussian& gaussian) {
  const double z = (grey_levels - gaussian.mean_levels) / gaussian.sigma_levels;
  return -0.5 * z * z - std::log(gaussian.sigma_levels * std::sqrt(2.0 * std::numbers::pi));
}

GreyClassifier::GreyClassifier(const Gaussians& gaussians) : gaussians_(gaussians) {
  for (std::size_t grey = 0; grey < label_of_grey_.size(); ++grey) {
    const auto best = std::max_element(gaussians_.begin(), gaussians_.end(),
                                       [&](const GreyGaussian& a, const GreyGaussian& b) {
                                         return log_likelihood(static_cast<double>(grey), a) <
                                                log_likelihood(static_cast<double>(grey), b);
                                       });
    label_of_grey_[grey] = kTrainedClasses[static_cast<std::size_t>(best - gaussians_.begin())];
  }
}

}  // namespace roomwise::segment
