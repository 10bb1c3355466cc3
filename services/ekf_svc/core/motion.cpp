#include "services/ekf_svc/core/motion.h"

#include <Eigen/LU>

#include "services/ekf_svc/core/planar_group.h"

namespace roomwise::ekf {
namespace {

constexpr int kRobot = RobotMatrix::RowsAtCompileTime;

/// [1 0; column 0, block] of the text.
Eigen::Matrix3d turn_then_move(const Eigen::Vector2d& per_turn, const Eigen::Matrix2d& per_move) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  jacobian(0, 0) = 1.0;
  jacobian.block<2, 1>(1, 0) = per_turn;
  jacobian.block<2, 2>(1, 1) = per_move;
  return jacobian;
}

}  // namespace

MotionStep arc_step(double distance_m, double turn_rad, const Eigen::Matrix2d& covariance) {
  MotionStep step;
  step.twist << turn_rad, distance_m, 0.0;
  step.covariance(0, 0) = covariance(1, 1);
  step.covariance(0, 1) = step.covariance(1, 0) = covariance(0, 1);
  step.covariance(1, 1) = covariance(0, 0);
  return step;
}

MotionStep speed_step(double distance_m, double turn_rad, const Eigen::Matrix2d& covariance) {
  MotionStep step = arc_step(distance_m, turn_rad, covariance);
  step.curve_rad = OdometryCalibration::curve_rad(distance_m, turn_rad);
  return step;
}

MotionStep chord_step(const Pose2& T_start_end, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector2d move =
      arc_matrix(T_start_end.heading_rad).inverse() * T_start_end.position_m();
  return {{T_start_end.heading_rad, move.x(), move.y()}, covariance};
}

MotionStep part_of(const MotionStep& step, double ratio) {
  return {ratio * step.twist, ratio * step.covariance, ratio * step.curve_rad};
}

void MotionIncrement::append(const MotionStep& step, const OdometryCalibration& calibration) {
  const Eigen::Matrix3d correction = calibration.correction();
  Eigen::Vector3d twist = correction * step.twist;
  twist(1) -= calibration.turn_loss_m_per_rad * step.curve_rad;
  const ArcCoefficients arc = arc_coefficients(twist(0));
  const Eigen::Vector2d velocity = twist.tail<2>();
  const Eigen::Matrix2d rotation = rotation2(turn_rad);
  const Eigen::Matrix2d reach = rotation * arc_matrix(arc);
  const Eigen::Vector2d move = reach * velocity;
  Eigen::Matrix2d arc_per_rad;
  arc_per_rad << arc.along_per_rad, -arc.across_per_rad, arc.across_per_rad, arc.along_per_rad;

  const Eigen::Matrix3d A = turn_then_move(quarter_turn(move), Eigen::Matrix2d::Identity());
  const Eigen::Matrix3d B = turn_then_move(rotation * arc_per_rad * velocity, reach);
  const Eigen::Matrix3d noise = B * correction;
  covariance = A * covariance * A.transpose() + noise * step.covariance * noise.transpose();
  per_calibration = A * per_calibration;
  per_calibration.leftCols<3>() += B * OdometryCalibration::twist_jacobian(step.twist);
  per_calibration.col(3) -= step.curve_rad * B.col(1);
  path_m += velocity.norm();
  translation_m += move;
  turn_rad += twist(0);
}

Pose2 moved(const Pose2& T_map_robot, const MotionIncrement& motion) {
  return compose(T_map_robot,
                 {motion.translation_m.x(), motion.translation_m.y(), motion.turn_rad});
}

RobotMatrix transition(double heading_rad, const MotionIncrement& motion) {
  const Eigen::Matrix2d rotation = rotation2(heading_rad);
  const Eigen::Matrix3d G = turn_then_move(Eigen::Vector2d::Zero(), rotation);
  RobotMatrix F = RobotMatrix::Identity();
  F.topLeftCorner<3, 3>() =
      turn_then_move(quarter_turn(rotation * motion.translation_m), Eigen::Matrix2d::Identity());
  F.block<3, 4>(0, 3) = G * motion.per_calibration;
  return F;
}

RobotMatrix moved_covariance(double heading_rad, const RobotMatrix& covariance,
                             const MotionIncrement& motion) {
  const RobotMatrix F = transition(heading_rad, motion);
  const Eigen::Matrix3d G = turn_then_move(Eigen::Vector2d::Zero(), rotation2(heading_rad));
  // F is the identity below the pose; lazyProduct: no kernel for large matrices.
  const Eigen::Matrix<double, 3, kRobot> pose_rows = F.topRows<3>().lazyProduct(covariance);
  RobotMatrix after = covariance;
  after.topRows<3>() = pose_rows;
  after.leftCols<3>() = pose_rows.transpose();
  after.topLeftCorner<3, 3>() = pose_rows.lazyProduct(F.topRows<3>().transpose());
  after.topLeftCorner<3, 3>() += G * motion.covariance * G.transpose();
  return after;
}

}  // namespace roomwise::ekf
