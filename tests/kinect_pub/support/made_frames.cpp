#include "tests/kinect_pub/support/made_frames.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace roomwise {
namespace {

constexpr std::int64_t kPeriod_us = 33'333;
constexpr std::int64_t kStart_us = 5'000'000;

/// Depths a Kinect can say, by disparity step.
std::uint16_t depth_of(int disparity) {
  static const auto table = [] {
    std::array<std::uint16_t, 1100> depths{};
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const double depth_m = 1.0 / (3.3309 - 0.0030711 * static_cast<double>(i));
      depths[i] = static_cast<std::uint16_t>(std::clamp(1000.0 * depth_m, 0.0, 9999.0));
    }
    return depths;
  }();
  return table[static_cast<std::size_t>(std::clamp(disparity, 0, 1047))];
}

/// Repeatable disorder: what noise looks like, without a generator to carry about.
std::uint32_t scramble(std::uint32_t value) {
  value ^= value >> 16U;
  value *= 0x7feb352dU;
  value ^= value >> 15U;
  value *= 0x846ca68bU;
  return value ^ value >> 16U;
}

void paint(std::int64_t number, int shift, bool registered, RgbdFrame& frame) {
  const int box_u_px = static_cast<int>(number * 3 % 500);
  for (int v = 0; v < frame.depth.height_px; ++v) {
    for (int u = 0; u < frame.depth.width_px; ++u) {
      const int full_u = u << shift;
      const int full_v = v << shift;
      const std::uint32_t noise = scramble(static_cast<std::uint32_t>(
          full_u + 640 * full_v + 307'200 * static_cast<int>(number % 1000)));
      const bool box = full_u >= box_u_px && full_u < box_u_px + 90 && full_v > 150 && full_v < 380;
      const int floor = full_v > 300 ? 985 - (full_v - 300) : 985;
      const int disparity = (box ? 800 : floor + full_u / 40) - static_cast<int>(noise % 2);
      const bool band = full_u >= 632 || (registered && full_u < 16);
      const bool hole = noise % 97 == 0 || band;
      frame.depth.steps.push_back(hole ? std::uint16_t{0} : depth_of(disparity));
    }
  }
}

void colour(std::int64_t number, int shift, ColorImage& color) {
  for (int v = 0; v < color.height_px; ++v) {
    for (int u = 0; u < color.width_px; ++u) {
      color.rgb.push_back(static_cast<std::uint8_t>((u << shift) / 3));
      color.rgb.push_back(static_cast<std::uint8_t>((v << shift) / 2));
      color.rgb.push_back(static_cast<std::uint8_t>(number));
    }
  }
}

}  // namespace

RgbdFrame made_frame(std::int64_t number, const simulator::FrameRequest& request) {
  RgbdFrame frame;
  frame.depth.width_px = request.depth_width_px;
  frame.depth.height_px = request.depth_width_px * 3 / 4;
  frame.color.width_px = request.color_width_px;
  frame.color.height_px = request.color_width_px * 3 / 4;
  frame.depth_registered = request.depth_registered;
  paint(number, request.depth_width_px == 320 ? 1 : 0, request.depth_registered, frame);
  colour(number, request.color_width_px == 320 ? 1 : 0, frame.color);
  return frame;
}

std::int64_t made_device_time_us(std::int64_t number) { return kStart_us + kPeriod_us * number; }

std::int64_t made_number(std::int64_t device_time_us) {
  return (device_time_us - kStart_us) / kPeriod_us;
}

}  // namespace roomwise
