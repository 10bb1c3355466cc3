#include "services/segment_svc/core/color_table.h"

#include <algorithm>
#include <stdexcept>

namespace roomwise::segment {
namespace {

constexpr std::size_t kSteps = 32;

Label best_label(const ColorTable::Mixtures& mixtures, const ColorFeature& x, double least) {
  std::array<double, GreyClassifier::kClasses.size()> log_likelihood{};
  for (std::size_t k = 0; k < mixtures.size(); ++k) {
    log_likelihood[k] = mixtures[k].log_likelihood(x);
  }
  const auto best = std::max_element(log_likelihood.begin(), log_likelihood.end());
  if (*best < least) return kUnknown;
  return GreyClassifier::kClasses[static_cast<std::size_t>(best - log_likelihood.begin())];
}

/// The middle of a step.
std::uint8_t level(std::size_t step) { return static_cast<std::uint8_t>(8 * step + 4); }

}  // namespace

ColorTable::ColorTable(const Mixtures& mixtures, double log_likelihood_min)
    : labels_(kSteps * kSteps * kSteps) {
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const ColorFeature x =
        color_feature(level(i / (kSteps * kSteps)), level(i / kSteps % kSteps), level(i % kSteps));
    labels_[i] = best_label(mixtures, x, log_likelihood_min);
  }
}

void ColorTable::classify(const ColorImage& color, std::span<std::uint8_t> labels) const {
  if (3 * labels.size() != color.rgb.size()) throw std::invalid_argument("labels: sizes differ");
  const std::uint8_t* rgb = color.rgb.data();
  for (std::uint8_t& label : labels) {
    label = classify(rgb[0], rgb[1], rgb[2]);
    rgb += 3;
  }
}

}  // namespace roomwise::segment
