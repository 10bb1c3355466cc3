#include "services/create_driver/core/calibration.h"

#include <cmath>

namespace roomwise::create {
namespace {

bool is_near(double value, double reference, double tolerance_ratio) {
  return std::abs(value - reference) <= tolerance_ratio * reference;  // false for NaN
}

}  // namespace

std::optional<WheelGeometry> calibrated(const WheelGeometry& geometry, const StraightRun& straight,
                                        const SpinRun& spin) {
  const double bend_rad = 2.0 * std::atan2(straight.left_m, straight.forward_m);
  const double chord_m = std::hypot(straight.forward_m, straight.left_m);
  const double half_rad = 0.5 * bend_rad;
  const double length_m = half_rad == 0.0 ? chord_m : chord_m * half_rad / std::sin(half_rad);
  const auto left = static_cast<double>(straight.ticks.left);
  const auto right = static_cast<double>(straight.ticks.right);
  const double left_ratio = static_cast<double>(spin.ticks.left) / left;
  const double right_ratio = static_cast<double>(spin.ticks.right) / right;

  WheelGeometry result = geometry;
  result.wheel_base_m = length_m * (right_ratio - left_ratio) /
                        (spin.turn_rad - half_rad * (right_ratio + left_ratio));
  const double left_m_per_tick = (length_m - half_rad * result.wheel_base_m) / left;
  const double right_m_per_tick = (length_m + half_rad * result.wheel_base_m) / right;
  const double mean = 0.5 * (left_m_per_tick + right_m_per_tick);
  result.wheel_diameter_m = geometry.wheel_diameter_m * mean / geometry.metres_per_tick();
  result.left_scale_ratio = left_m_per_tick / mean;
  result.right_scale_ratio = right_m_per_tick / mean;

  const bool is_plausible = is_near(result.wheel_base_m, geometry.wheel_base_m, 0.2) &&
                            is_near(result.wheel_diameter_m, geometry.wheel_diameter_m, 0.1) &&
                            is_near(result.left_scale_ratio, 1.0, 0.05);
  return is_plausible ? std::optional(result) : std::nullopt;
}

}  // namespace roomwise::create
