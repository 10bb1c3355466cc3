#pragma once

namespace roomwise::create {

/// What the two wheels are to do.
struct WheelSpeeds {
  double left_mps = 0.0;
  double right_mps = 0.0;
  friend bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};

/// Wheel speeds that drive the body at `speed_mps` while it turns at `turn_rate_radps`.
constexpr WheelSpeeds wheel_speeds(double speed_mps, double turn_rate_radps, double wheel_base_m) {
  const double half_mps = 0.5 * turn_rate_radps * wheel_base_m;
  return {speed_mps - half_mps, speed_mps + half_mps};
}

/// The same curve at a speed no wheel exceeds: both are multiplied by one factor, at most 1.
constexpr WheelSpeeds limited(const WheelSpeeds& wanted, double speed_max_mps) {
  const double left = wanted.left_mps < 0.0 ? -wanted.left_mps : wanted.left_mps;
  const double right = wanted.right_mps < 0.0 ? -wanted.right_mps : wanted.right_mps;
  const double fastest = left > right ? left : right;
  if (fastest <= speed_max_mps) return wanted;
  const double factor = speed_max_mps / fastest;
  return {wanted.left_mps * factor, wanted.right_mps * factor};
}

}  // namespace roomwise::create
