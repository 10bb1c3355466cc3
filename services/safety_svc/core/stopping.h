#pragma once
#include <algorithm>
#include <cmath>

#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {

/// How far the robot goes on at `speed_mps` (>= 0) when it must stop: v t + v^2 / (2 a) [m].
constexpr double stopping_distance_m(double speed_mps) {
  return speed_mps * kReaction_s + speed_mps * speed_mps / (2.0 * kBraking_mps2);
}

/// The fastest speed that stops within `distance_m`, stopping_distance_m's inverse; 0 if there is
/// no distance [m/s].
inline double stopping_speed_mps(double distance_m) {
  const double free_m = std::max(0.0, distance_m);
  const double at_mps = kBraking_mps2 * kReaction_s;
  return std::sqrt(at_mps * at_mps + 2.0 * kBraking_mps2 * free_m) - at_mps;
}

}  // namespace roomwise::safety
