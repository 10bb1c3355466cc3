#include "services/simulator/core/create/drive_request.h"

#include <algorithm>
#include <cmath>

namespace roomwise::simulator {
namespace {

constexpr int kLargest_mmps = 500;
constexpr int kLargestRadius_mm = 2000;
constexpr double kRobotRadius_m = 0.17;

std::int16_t clamped(int value, int largest) {
  return static_cast<std::int16_t>(std::clamp(value, -largest, largest));
}

bool is_straight(std::int16_t radius_mm) { return radius_mm == 32767 || radius_mm == -32768; }

}  // namespace

void DriveRequest::set_arc(std::int16_t velocity_mmps, std::int16_t radius_mm,
                           double wheel_base_m) {
  stop();
  velocity_mmps_ = clamped(velocity_mmps, kLargest_mmps);
  radius_mm_ = is_straight(radius_mm) ? radius_mm : clamped(radius_mm, kLargestRadius_mm);
  const double v_mps = velocity_mmps_ * 1e-3;
  if (is_straight(radius_mm_) || radius_mm_ == 0) {
    wheels_mps_ = {v_mps, v_mps};
  } else if (radius_mm_ == 1 || radius_mm_ == -1) {
    wheels_mps_ = {-radius_mm_ * v_mps, radius_mm_ * v_mps};
  } else {
    const double aside = wheel_base_m / 2.0 / (radius_mm_ * 1e-3);
    const double fastest_mps = std::abs(v_mps) * (1.0 + std::abs(aside));
    const double ratio = std::min(1.0, kLargest_mmps * 1e-3 / std::max(fastest_mps, 1e-9));
    wheels_mps_ = {ratio * v_mps * (1.0 - aside), ratio * v_mps * (1.0 + aside)};
  }
}

void DriveRequest::set_direct(LeftRight<std::int16_t> mmps) {
  stop();
  direct_mmps_ = {clamped(mmps.left, kLargest_mmps), clamped(mmps.right, kLargest_mmps)};
  wheels_mps_ = {direct_mmps_.left * 1e-3, direct_mmps_.right * 1e-3};
}

void DriveRequest::set_pwm(LeftRight<std::int16_t> pwm) {
  stop();
  const double unit_mps = kLargest_mmps * 1e-3 / 255.0;
  wheels_mps_ = {clamped(pwm.left, 255) * unit_mps, clamped(pwm.right, 255) * unit_mps};
}

bool DriveRequest::minds_cliffs(double wheel_base_m) const {
  const double sum = wheels_mps_.left + wheels_mps_.right;
  const double difference = wheels_mps_.right - wheels_mps_.left;
  if (sum > 0.0) return true;
  return sum < 0.0 && std::abs(sum) * wheel_base_m / 2.0 < kRobotRadius_m * std::abs(difference);
}

}  // namespace roomwise::simulator
