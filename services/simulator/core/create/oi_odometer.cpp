#include "services/simulator/core/create/oi_odometer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise::simulator {

void OiOdometer::sample(const LeftRight<double>& turned_m) {
  const double left_m = turned_m.left - last_m_.left;
  const double right_m = turned_m.right - last_m_.right;
  const double turn_rad = (right_m - left_m) / setup_.wheel_base_m;
  distance_mm_ += setup_.distance_ratio * 1000.0 * (left_m + right_m) / 2.0;
  angle_deg_ += setup_.angle_ratio * turn_rad * 180.0 / std::numbers::pi;
  last_m_ = turned_m;
}

std::int16_t OiOdometer::take_distance_mm() { return take(distance_mm_); }

std::int16_t OiOdometer::take_angle_deg() { return take(angle_deg_); }

std::int16_t OiOdometer::take(double& gathered) const {
  const double whole = std::trunc(std::clamp(gathered, -32768.0, 32767.0));
  gathered = setup_.carries ? gathered - std::trunc(gathered) : 0.0;
  return static_cast<std::int16_t>(whole);
}

}  // namespace roomwise::simulator
