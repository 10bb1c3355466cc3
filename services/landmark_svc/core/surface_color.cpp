#include "services/landmark_svc/core/surface_color.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {

void SurfaceColor::add(const std::uint8_t* rgb) {
  constexpr int kSaturated = 250;
  const int brightest = std::max({rgb[0], rgb[1], rgb[2]});
  const int darkest = std::min({rgb[0], rgb[1], rgb[2]});
  if (brightest >= kSaturated || darkest < 1) return;
  if (rgb[0] + 2 * rgb[1] + rgb[2] < 4.0 * dark_luma_levels_) return;
  ++count_;
  for (int c = 0; c < 3; ++c) {
    sum_[c] += rgb[c];
    sum_of_squares_[c] += rgb[c] * rgb[c];
  }
}

ChromaSignature SurfaceColor::signature() const {
  constexpr std::int64_t kFewest = 5;
  constexpr double kIndependentMost = 9.0;
  constexpr double kDrift_log = 0.05;
  if (count_ < kFewest) return {};
  const double n = std::min(static_cast<double>(count_), kIndependentMost);
  const double green = relative_variance(1, n);
  const double worse = std::max(relative_variance(0, n), relative_variance(2, n));
  const auto log_ratio = [this](int channel) {
    return std::log(static_cast<double>(sum_[channel]) / static_cast<double>(sum_[1]));
  };
  return {.red_log = log_ratio(0),
          .blue_log = log_ratio(2),
          .variance_log2 = worse + green + kDrift_log * kDrift_log};
}

double SurfaceColor::relative_variance(int channel, double n_independent) const {
  const double n = static_cast<double>(count_);
  const double mean = static_cast<double>(sum_[channel]) / n;
  const double spread = static_cast<double>(sum_of_squares_[channel]) / n - mean * mean;
  return (std::max(spread, 0.0) + noise_levels_ * noise_levels_) / (n_independent * mean * mean);
}

}  // namespace roomwise::landmark
