#pragma once
#include <cmath>
#include <numbers>

namespace roomwise {

/// The same direction in [-pi, pi).
inline double wrap_angle(double angle_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double wrapped = angle_rad - kTurn * std::floor((angle_rad + std::numbers::pi) / kTurn);
  return wrapped < std::numbers::pi ? wrapped : -std::numbers::pi;  // rounding just below -pi
}

}  // namespace roomwise
