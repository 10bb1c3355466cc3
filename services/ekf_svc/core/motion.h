#pragma once
#include <Eigen/Core>

#include "common/geometry/pose2.h"

namespace roomwise::ekf {

/// A stretch of odometry at constant twist, in the frame of the robot.
///   twist       3      (turn_rad, forward_m, leftward_m); leftward is 0 for rolling wheels
///   covariance  3 x 3  of the twist, same order
struct MotionStep {
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// An exact circular arc of wheels that do not slide.
MotionStep arc_step(double distance_m, double turn_rad, const Eigen::Matrix2d& covariance);

/// The constant twist that leads from the origin to `T_start_end`. |heading| < pi.
MotionStep chord_step(const Pose2& T_start_end, const Eigen::Matrix3d& covariance);

/// The part of a step's time, 0 <= ratio <= 1. The parts' noises are independent, so that
/// covariances add up to the whole step's.
MotionStep part_of(const MotionStep& step, double ratio);

/// Where steps lead, taken together, in the frame of the robot before the first of them.
///   covariance  3 x 3  of (turn, x, y), additive errors [rad^2, rad m, m^2]
struct MotionIncrement {
  double turn_rad = 0.0;  ///< not wrapped
  Eigen::Vector2d translation_m = Eigen::Vector2d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Appends a step, with d = V(turn) (forward, leftward):
  ///   translation += R d;  turn += step's;  Q = A Q A^T + B q B^T,
  ///   A = [1 0; J R d, I],  B = [1 0; R V'(turn) v, R V(turn)],  R = R(turn so far).
  void append(const MotionStep& step);
};

/// Pose after the motion. The heading is wrapped.
Pose2 moved(const Pose2& T_map_robot, const MotionIncrement& motion);

/// Covariance of moved() from that of the pose before; both of (heading, x, y):
///   F P F^T + G Q G^T,  F = [1 0; J R dp, I],  G = [1 0; 0 R].
Eigen::Matrix3d moved_covariance(double heading_rad, const Eigen::Matrix3d& covariance,
                                 const MotionIncrement& motion);

}  // namespace roomwise::ekf
