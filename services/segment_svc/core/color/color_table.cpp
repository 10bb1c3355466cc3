#include "services/segment_svc/core/color/color_table.h"

#include <algorithm>

namespace roomwise::segment {
namespace {

constexpr std::size_t kSteps = 32;
constexpr double kSigmas = 5.0;

/// Log-likelihood of a colour `kSigmas` off the part that is faintest there.
double least_likely(const ClassMixtures& mixtures) {
  double least = mixtures[0].log_share(0, mixtures[0].parts()[0].mean);
  for (const Mixture& mixture : mixtures) {
    for (std::size_t k = 0; k < mixture.parts().size(); ++k) {
      least = std::min(least, mixture.log_share(k, mixture.parts()[k].mean));
    }
  }
  return least - 0.5 * kSigmas * kSigmas;
}

Label best_label(const ClassMixtures& mixtures, const ColorFeature& x, double least) {
  std::array<double, kTrainedClasses.size()> log_likelihood{};
  for (std::size_t k = 0; k < mixtures.size(); ++k) {
    log_likelihood[k] = mixtures[k].log_likelihood(x);
  }
  const auto best = std::max_element(log_likelihood.begin(), log_likelihood.end());
  if (*best < least) return kUnknown;
  return kTrainedClasses[static_cast<std::size_t>(best - log_likelihood.begin())];
}

/// The middle of a step.
std::uint8_t level(std::size_t step) { return static_cast<std::uint8_t>(8 * step + 4); }

}  // namespace

ColorTable::ColorTable(const ClassMixtures& mixtures) {
  const double least = least_likely(mixtures);
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const ColorFeature x =
        color_feature(level(i / (kSteps * kSteps)), level(i / kSteps % kSteps), level(i % kSteps));
    labels_[i] = best_label(mixtures, x, least);
  }
}

}  // namespace roomwise::segment
