#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace roomwise::ekf {

/// What wheels get wrong all the time: worn or soft tyres, a wheel base measured badly, speeds
/// reported on another scale. The true motion, with u the reported one and b the wheel base, is
///   distance = (1 + distance_ratio) u_distance + b^2 / 4 turn_per_distance u_turn
///   turn     = (1 + turn_ratio) u_turn + turn_per_distance u_distance,
/// which is exact for wheels whose radii and base are off: with s_l, s_r the wheels' scales and
/// b' the true base, 1 + distance_ratio = (s_l + s_r) / 2, turn_per_distance = (s_r - s_l) / b',
/// 1 + turn_ratio = (1 + distance_ratio) b / b'. (In b b' / 4, b' is taken for b.)
///
/// Speeds that were asked for, not counted at the wheels, lose in curves: distance lost =
/// turn_loss |u_turn|, less in a curve so tight that the inner wheel turns back, nothing where the
/// robot turns on the spot; see curve_rad().
struct OdometryCalibration {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [-, -, rad/m], in the order above
  double turn_loss_m_per_rad = 0.0;

  double distance_ratio() const { return value(0); }
  double turn_ratio() const { return value(1); }
  double turn_per_distance_rad_per_m() const { return value(2); }

  /// The true twist (turn, forward, leftward) from the reported one. Shape 3 x 3.
  Eigen::Matrix3d correction() const {
    const double forward = 1.0 + value(0);
    return (Eigen::Matrix3d() << 1.0 + value(1), value(2), 0.0, kLever_m2 * value(2), forward, 0.0,
            0.0, 0.0, forward)
        .finished();
  }

  /// d (true twist) / d value at the reported twist `u`. Shape 3 x 3.
  static Eigen::Matrix3d twist_jacobian(const Eigen::Vector3d& u) {
    return (Eigen::Matrix3d() << 0.0, u(0), u(1), u(1), 0.0, kLever_m2 * u(0), u(2), 0.0, 0.0)
        .finished();
  }

  /// What the loss of a reported motion is proportional to. Homogeneous of degree 1: parts of a
  /// motion add up to the whole.
  static double curve_rad(double distance_m, double turn_rad) {
    const double reach_rad = std::abs(turn_rad);
    return std::clamp(2.0 * distance_m / kWheelBase_m, -reach_rad, reach_rad);
  }

  static constexpr double kWheelBase_m = 0.235;  ///< Create 2; a few cm more hardly matter
  static constexpr double kLever_m2 = kWheelBase_m * kWheelBase_m / 4.0;
};

}  // namespace roomwise::ekf
