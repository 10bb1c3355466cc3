#include "tests/landmark_svc/support/kinect_effects.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

namespace roomwise {
namespace {

std::span<std::uint16_t> row_of(DepthImage& depth, int v_px) {
  const auto width = static_cast<std::size_t>(depth.width_px);
  return std::span(depth.steps).subspan(static_cast<std::size_t>(v_px) * width, width);
}

int random_below(std::minstd_rand& random, int end) {
  return static_cast<int>(random() % static_cast<unsigned>(end));
}

}  // namespace

void add_projector_shadow(DepthImage& depth, double quanta_m) {
  const double disparity_px_m = quanta_m / 8.0 * depth.width_px / 640.0;
  for (int v = 0; v < depth.height_px; ++v) {
    double lit_from_px = -1e9;
    int u = 0;
    for (std::uint16_t& step : row_of(depth, v)) {
      const double column_px = u++ + (step == 0 ? 0.0 : disparity_px_m / (step * depth.unit_m));
      if (column_px < lit_from_px) step = 0;
      lit_from_px = std::max(lit_from_px, column_px);
    }
  }
}

void add_ragged_edges(DepthImage& depth, std::uint32_t seed) {
  std::minstd_rand random(seed + 1);
  for (int v = 0; v < depth.height_px;) {
    const int shift = random_below(random, 3) - 1;
    const int rows = 1 + random_below(random, 4);
    for (int last = std::min(v + rows, depth.height_px); v < last; ++v) {
      const auto row = row_of(depth, v);
      if (shift > 0) std::shift_right(row.begin(), row.end(), shift);
      if (shift < 0) std::shift_left(row.begin(), row.end(), -shift);
    }
  }
}

void add_dropouts(DepthImage& depth, double share, std::uint32_t seed) {
  constexpr int kRun = 6;
  std::minstd_rand random(seed + 1);
  const auto runs = static_cast<int>(share * static_cast<double>(depth.size()) / (kRun / 2.0));
  for (int i = 0; i < runs; ++i) {
    const auto first = static_cast<std::size_t>(random() % depth.size());
    const std::size_t length = 1 + random() % kRun;
    const std::size_t end = std::min(first + length, depth.size());
    for (std::size_t k = first; k < end; ++k) depth.steps[k] = 0;
  }
}

RgbdFrame mirrored(const RgbdFrame& frame) {
  RgbdFrame result = frame;
  for (int v = 0; v < result.depth.height_px; ++v) {
    const auto row = row_of(result.depth, v);
    std::reverse(row.begin(), row.end());
  }
  const auto width = static_cast<std::size_t>(frame.color.width_px);
  for (std::size_t i = 0; i < frame.color.rgb.size(); ++i) {
    const std::size_t pixel = i / 3;
    const std::size_t from = pixel / width * width + (width - 1 - pixel % width);
    result.color.rgb[i] = frame.color.rgb[3 * from + i % 3];
  }
  result.depth_camera.cx_px = frame.depth.width_px - 1 - frame.depth_camera.cx_px;
  return result;
}

DepthImage plane_image(int width_px, int height_px, double quanta, double du, double dv,
                       double noise_quanta, std::uint32_t seed) {
  std::minstd_rand random(seed + 1);
  DepthImage depth{.width_px = width_px, .height_px = height_px, .unit_m = 0.001, .steps = {}};
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double noise = noise_quanta * (random_below(random, 2001) / 1000.0 - 1.0);
      const double measured = std::round(quanta + du * u + dv * v + noise);
      const double depth_m = measured > 0.0 ? 351.0 / measured : 100.0;
      const bool in_reach = depth_m >= 0.5 && depth_m <= 4.0;
      depth.steps.push_back(in_reach ? static_cast<std::uint16_t>(std::lround(1000.0 * depth_m))
                                     : std::uint16_t{0});
    }
  }
  return depth;
}

}  // namespace roomwise
