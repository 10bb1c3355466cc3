#pragma once
#include <Eigen/Core>

#include "common/geometry/pose2.h"
#include "services/ekf_svc/core/odometry_calibration.h"

namespace roomwise::ekf {

/// A stretch of odometry at constant twist, in the frame of the robot.
///   twist       3      (turn_rad, forward_m, leftward_m); leftward is 0 for rolling wheels
///   covariance  3 x 3  of the twist, same order
///   curve_rad          OdometryCalibration::curve_rad() of a speed that was asked for; else 0
struct MotionStep {
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double curve_rad = 0.0;
};

/// An exact circular arc of wheels that do not slide.
MotionStep arc_step(double distance_m, double turn_rad, const Eigen::Matrix2d& covariance);

/// The same of a speed and a turn rate that were asked for, over some time.
MotionStep speed_step(double distance_m, double turn_rad, const Eigen::Matrix2d& covariance);

/// The constant twist that leads from the origin to `T_start_end`. |heading| < pi.
MotionStep chord_step(const Pose2& T_start_end, const Eigen::Matrix3d& covariance);

/// The part of a step's time, 0 <= ratio <= 1. The parts' noises are independent, so that
/// covariances add up to the whole step's.
MotionStep part_of(const MotionStep& step, double ratio);

/// Where steps lead, taken together, in the frame of the robot before the first of them.
///   covariance       3 x 3  of (turn, x, y), additive errors [rad^2, rad m, m^2]
///   per_calibration  3 x 4  d (turn, x, y) / d OdometryCalibration
struct MotionIncrement {
  double turn_rad = 0.0;  ///< not wrapped
  Eigen::Vector2d translation_m = Eigen::Vector2d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 4> per_calibration = Eigen::Matrix<double, 3, 4>::Zero();
  double path_m = 0.0;  ///< way gone, forward or back

  /// Appends a step, corrected by `calibration`, with d = V(turn) (forward, leftward):
  ///   translation += R d;  turn += step's;  Q = A Q A^T + B q B^T,
  ///   A = [1 0; J R d, I],  B = [1 0; R V'(turn) v, R V(turn)],  R = R(turn so far).
  void append(const MotionStep& step, const OdometryCalibration& calibration = {});
};

/// Pose after the motion. The heading is wrapped.
Pose2 moved(const Pose2& T_map_robot, const MotionIncrement& motion);

using RobotMatrix = Eigen::Matrix<double, 9, 9>;

/// Covariance after the motion from that before, both of (heading, x, y, OdometryCalibration,
/// RangeCalibration):
///   F P F^T + G Q G^T,  F = [1 0 D_0 0; J R dp, I, R D_p, 0; 0 0 I 0; 0 0 0 I],
///   G = [1 0; 0 R; 0 0; 0 0],  with D_0 and D_p the rows of per_calibration.
RobotMatrix moved_covariance(double heading_rad, const RobotMatrix& covariance,
                             const MotionIncrement& motion);

/// The F of moved_covariance().
RobotMatrix transition(double heading_rad, const MotionIncrement& motion);

}  // namespace roomwise::ekf
