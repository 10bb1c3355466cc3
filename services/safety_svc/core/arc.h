#pragma once
#include <cmath>

#include "common/geometry/pose2.h"

namespace roomwise::safety {

/// Where the robot is after `distance_m` (negative in reverse) along an arc that turns by
/// `curvature_radpm` a metre, from the origin of its own frame. Turning on the spot has no arc.
///
/// The chord's length is d sin(h) / h with h half the turn, along the mid heading.
inline Pose2 along_arc(double distance_m, double curvature_radpm) {
  const double half_rad = 0.5 * distance_m * curvature_radpm;
  const double ratio = std::abs(half_rad) < 1e-6 ? 1.0 : std::sin(half_rad) / half_rad;
  const double chord_m = distance_m * ratio;
  return {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), wrap_angle(2.0 * half_rad)};
}

}  // namespace roomwise::safety
