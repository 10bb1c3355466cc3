#include "services/landmark_svc/core/color_weight.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {

double mean_luma_levels(const ColorImage& color) {
  constexpr std::size_t kStride = 16;  // every 16th pixel says enough about a mean
  const std::size_t pixels = color.rgb.size() / 3;
  std::uint64_t sum = 0;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < pixels; i += kStride, ++count) {
    const std::uint8_t* p = color.rgb.data() + 3 * i;
    sum += static_cast<std::uint64_t>(p[0]) + 2u * p[1] + p[2];
  }
  return count == 0 ? 0.0 : static_cast<double>(sum) / (4.0 * static_cast<double>(count));
}

double color_weight_ratio(const ColorWeightParams& params, double luma_levels) {
  const double span = params.light_luma_levels - params.dark_luma_levels;
  const double light = (luma_levels - params.dark_luma_levels) / std::max(span, 1e-6);
  return params.alpha_max_ratio * std::clamp(light, 0.0, 1.0);
}

void ColorAtDepth::attach(const RgbdFrame& frame) {
  const ColorImage& color = frame.color;
  const bool usable = frame.depth_registered && !color.empty() && color.width_px > 0 &&
                      color.height_px > 0 && frame.depth.width_px > 0 &&
                      color.rgb.size() == 3 * static_cast<std::size_t>(color.width_px) *
                                              static_cast<std::size_t>(color.height_px);
  rgb_ = usable ? color.rgb.data() : nullptr;
  if (!usable) return;
  color_height_px_ = color.height_px;
  depth_height_px_ = frame.depth.height_px;
  color_row_bytes_ = 3 * static_cast<std::size_t>(color.width_px);
  const auto depth_width = static_cast<std::size_t>(frame.depth.width_px);
  column_offset_.resize(depth_width);
  for (std::size_t u = 0; u < depth_width; ++u) {
    column_offset_[u] = 3 * (u * static_cast<std::size_t>(color.width_px) / depth_width);
  }
}

double ColorAtDepth::distance_levels(int u1_px, int v1_px, int u2_px, int v2_px) const {
  const std::uint8_t* a = rgb(u1_px, v1_px);
  const std::uint8_t* b = rgb(u2_px, v2_px);
  int sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(static_cast<double>(sum));
}

}  // namespace roomwise::landmark
