#pragma once
#include <Eigen/Core>
#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise {

/// Rotation by `angle_rad`, counter-clockwise. Shape 2 x 2.
inline Eigen::Matrix2d rotation2(double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

/// A pose in the plane: T_a_b says where frame b is in frame a.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;  ///< [-pi, pi), counter-clockwise from a's x

  Eigen::Vector2d position_m() const { return {x_m, y_m}; }
};

/// T_a_c from T_a_b and T_b_c.
inline Pose2 compose(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Eigen::Vector2d p = T_a_b.position_m() + rotation2(T_a_b.heading_rad) * T_b_c.position_m();
  return {p.x(), p.y(), wrap_angle(T_a_b.heading_rad + T_b_c.heading_rad)};
}

/// T_b_a from T_a_b.
inline Pose2 inverse(const Pose2& T_a_b) {
  const Eigen::Vector2d p = -(rotation2(-T_a_b.heading_rad) * T_a_b.position_m());
  return {p.x(), p.y(), wrap_angle(-T_a_b.heading_rad)};
}

/// The point `p_b_m` of frame b in frame a.
inline Eigen::Vector2d transform(const Pose2& T_a_b, const Eigen::Vector2d& p_b_m) {
  return T_a_b.position_m() + rotation2(T_a_b.heading_rad) * p_b_m;
}

}  // namespace roomwise
