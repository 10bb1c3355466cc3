#pragma once
#include <cstdint>

#include "services/landmark_svc/core/landmark.h"

namespace roomwise::landmark {

/// Gathers pixels of one surface into its chroma signature. The logarithm of a ratio of channels
/// does not change with the brightness of the light.
class SurfaceColor {
 public:
  /// `dark_luma_levels`: pixels below are left out, as are saturated ones.
  /// `noise_levels`: sigma of one channel of one pixel.
  SurfaceColor(double dark_luma_levels, double noise_levels)
      : dark_luma_levels_(dark_luma_levels), noise_levels_(noise_levels) {}

  /// Takes a pixel: red, green, blue.
  void add(const std::uint8_t* rgb);

  /// ln of the ratios of the channel means. To first order, with m the mean and s^2 the variance
  /// of a channel over n pixels,
  ///   variance = (s_c^2 + noise^2) / (n m_c^2) + (s_g^2 + noise^2) / (n m_g^2) + drift^2
  /// for the worse of red and blue; n counts at most 9, neighbours being alike, and the drift of
  /// 0.05 stands for white balance and viewing angle. No colour where fewer than 5 pixels serve.
  ChromaSignature signature() const;

 private:
  double relative_variance(int channel, double n_independent) const;

  double dark_luma_levels_;
  double noise_levels_;
  std::int64_t count_ = 0;
  std::int64_t sum_[3] = {0, 0, 0};
  std::int64_t sum_of_squares_[3] = {0, 0, 0};
};

}  // namespace roomwise::landmark
