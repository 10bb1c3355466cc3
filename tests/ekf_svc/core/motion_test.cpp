#include "services/ekf_svc/core/motion.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "services/ekf_svc/core/planar_group.h"

namespace roomwise::ekf {
namespace {

double in_range(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1'000'001) * 1e-6;
}

MotionStep arbitrary_step() {
  MotionStep step;
  step.twist << in_range(-2.0, 2.0), in_range(-1.0, 1.0), in_range(-0.3, 0.3);
  const Eigen::Matrix3d root =
      (Eigen::Matrix3d() << 0.1, 0.0, 0.0, 0.02, 0.05, 0.0, 0.01, 0.0, 0.03).finished();
  step.covariance = in_range(0.1, 2.0) * root * root.transpose();
  return step;
}

Eigen::Vector3d end_of(const MotionIncrement& before, const Eigen::Vector3d& twist) {
  MotionIncrement motion = before;
  motion.append({twist, Eigen::Matrix3d::Zero()});
  return {motion.turn_rad, motion.translation_m.x(), motion.translation_m.y()};
}

/// Central differences of `f` at `at`, column by column.
template <class Function>
Eigen::Matrix3d numeric_jacobian(Function f, const Eigen::Vector3d& at) {
  constexpr double kStep = 1e-5;
  Eigen::Matrix3d jacobian;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d nudge = kStep * Eigen::Vector3d::Unit(k);
    jacobian.col(k) = (f(at + nudge) - f(at - nudge)) / (2.0 * kStep);
  }
  return jacobian;
}

TEST(Motion, QuarterCircleEndsWhereGeometrySays) {
  MotionIncrement motion;
  motion.append(arc_step(std::numbers::pi, std::numbers::pi / 2.0, Eigen::Matrix2d::Zero()));
  EXPECT_NEAR(motion.translation_m.x(), 2.0, 1e-12);
  EXPECT_NEAR(motion.translation_m.y(), 2.0, 1e-12);
  EXPECT_NEAR(motion.turn_rad, std::numbers::pi / 2.0, 1e-15);
}

TEST(Motion, ArcSeriesMeetsTheClosedForm) {
  for (const double e : {9.999e-3, -9.999e-3}) {
    const ArcCoefficients series = arc_coefficients(e);
    const ArcCoefficients closed = arc_coefficients(e * (0.0100001 / 9.999e-3));
    EXPECT_NEAR(series.along, closed.along, 1e-8);
    EXPECT_NEAR(series.across, closed.across, 1e-6);
    EXPECT_NEAR(series.along, std::sin(e) / e, 1e-15);
    EXPECT_NEAR(series.across, (1.0 - std::cos(e)) / e, 1e-13);
    EXPECT_NEAR(series.along_per_rad, (std::cos(e) - std::sin(e) / e) / e, 1e-12);
    EXPECT_NEAR(series.across_per_rad, (std::sin(e) - (1.0 - std::cos(e)) / e) / e, 1e-10);
  }
}

RC_GTEST_PROP(Motion, PartsOfAStepMakeTheWhole, ()) {
  const MotionStep step = arbitrary_step();
  const double ratio = in_range(0.0, 1.0);
  MotionIncrement whole, parts;
  whole.append(step);
  parts.append(part_of(step, ratio));
  parts.append(part_of(step, 1.0 - ratio));
  RC_ASSERT((whole.translation_m - parts.translation_m).norm() < 1e-12);
  RC_ASSERT(std::abs(whole.turn_rad - parts.turn_rad) < 1e-12);
}

RC_GTEST_PROP(Motion, ChordStepLeadsToItsEnd, ()) {
  const Pose2 end{in_range(-2.0, 2.0), in_range(-2.0, 2.0), in_range(-3.0, 3.0)};
  MotionIncrement motion;
  motion.append(chord_step(end, Eigen::Matrix3d::Zero()));
  RC_ASSERT((motion.translation_m - end.position_m()).norm() < 1e-11);
  RC_ASSERT(std::abs(motion.turn_rad - end.heading_rad) < 1e-12);
}

RC_GTEST_PROP(Motion, CovarianceUsesTheNumericJacobians, ()) {
  MotionIncrement before;
  before.append(arbitrary_step());
  const MotionStep step = arbitrary_step();
  MotionIncrement after = before;
  after.append(step);

  const Eigen::Matrix3d B = numeric_jacobian(
      [&](const Eigen::Vector3d& twist) { return end_of(before, twist); }, step.twist);
  const Eigen::Matrix3d A = numeric_jacobian(
      [&](const Eigen::Vector3d& start) {
        MotionIncrement moved_start;
        moved_start.turn_rad = start(0);
        moved_start.translation_m = start.tail<2>();
        return end_of(moved_start, step.twist);
      },
      {before.turn_rad, before.translation_m.x(), before.translation_m.y()});
  const Eigen::Matrix3d expected =
      A * before.covariance * A.transpose() + B * step.covariance * B.transpose();
  RC_ASSERT((after.covariance - expected).cwiseAbs().maxCoeff() < 1e-8);
}

RC_GTEST_PROP(Motion, MovedCovarianceUsesTheNumericJacobians, ()) {
  MotionIncrement motion;
  motion.append(arbitrary_step());
  const Pose2 pose{in_range(-3.0, 3.0), in_range(-3.0, 3.0), in_range(-1.0, 1.0)};
  const Eigen::Matrix3d P = arbitrary_step().covariance;
  const auto end = [](const Pose2& from, const MotionIncrement& by) {
    const Eigen::Vector2d p = transform(from, by.translation_m);
    return Eigen::Vector3d(from.heading_rad + by.turn_rad, p.x(), p.y());
  };
  const Eigen::Matrix3d F = numeric_jacobian(
      [&](const Eigen::Vector3d& x) {
        return end({x(1), x(2), x(0)}, motion);
      },
      {pose.heading_rad, pose.x_m, pose.y_m});
  const Eigen::Matrix3d G = numeric_jacobian(
      [&](const Eigen::Vector3d& m) {
        MotionIncrement by;
        by.turn_rad = m(0);
        by.translation_m = m.tail<2>();
        return end(pose, by);
      },
      {motion.turn_rad, motion.translation_m.x(), motion.translation_m.y()});
  const Eigen::Matrix3d expected = F * P * F.transpose() + G * motion.covariance * G.transpose();
  RobotMatrix robot = RobotMatrix::Zero();
  robot.topLeftCorner<3, 3>() = P;
  const Eigen::Matrix3d actual =
      moved_covariance(pose.heading_rad, robot, motion).topLeftCorner<3, 3>();
  RC_ASSERT((actual - expected).cwiseAbs().maxCoeff() < 1e-8);
}

RC_GTEST_PROP(Motion, WhatCalibrationDoesIsTheNumericJacobian, ()) {
  const auto end = [](const OdometryCalibration& calibration, const MotionStep& first,
                      const MotionStep& second) {
    MotionIncrement motion;
    motion.append(first, calibration);
    motion.append(second, calibration);
    return motion;
  };
  const auto asked_for = [] {
    return speed_step(in_range(-1.0, 1.0), in_range(-2.0, 2.0), Eigen::Matrix2d::Zero());
  };
  const MotionStep first = asked_for(), second = asked_for();
  const OdometryCalibration held{{0.05, -0.03, 0.02}, 0.04};
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 4; ++k) {
    OdometryCalibration more = held, less = held;
    (k < 3 ? more.value(k) : more.turn_loss_m_per_rad) += kStep;
    (k < 3 ? less.value(k) : less.turn_loss_m_per_rad) -= kStep;
    const MotionIncrement high = end(more, first, second), low = end(less, first, second);
    const Eigen::Vector2d by = (high.translation_m - low.translation_m) / (2.0 * kStep);
    const Eigen::Vector3d numeric((high.turn_rad - low.turn_rad) / (2.0 * kStep), by.x(), by.y());
    RC_ASSERT((end(held, first, second).per_calibration.col(k) - numeric).norm() < 1e-7);
  }
}

RC_GTEST_PROP(Motion, PartsOfASpeedLoseWhatTheWholeLoses, ()) {
  const MotionStep whole =
      speed_step(in_range(-1.0, 1.0), in_range(-2.0, 2.0), Eigen::Matrix2d::Zero());
  const double ratio = in_range(0.0, 1.0);
  const Eigen::Vector3d twist = ratio * whole.twist;
  RC_ASSERT(std::abs(part_of(whole, ratio).curve_rad -
                     OdometryCalibration::curve_rad(twist(1), twist(0))) < 1e-12);
}

TEST(Motion, SpeedsLoseInCurvesAndNeitherStraightOnNorOnTheSpot) {
  const OdometryCalibration loses{{0.0, 0.0, 0.0}, 0.09};
  const auto way_m = [&](double distance_m, double turn_rad) {
    MotionIncrement motion;
    motion.append(speed_step(distance_m, turn_rad, Eigen::Matrix2d::Zero()), loses);
    return std::copysign(motion.path_m, distance_m);
  };
  EXPECT_NEAR(way_m(0.3, 0.0), 0.3, 1e-12);
  EXPECT_NEAR(way_m(0.3, 1.0), 0.3 - 0.09, 1e-12);
  EXPECT_NEAR(way_m(0.3, -1.0), 0.3 - 0.09, 1e-12);
  EXPECT_NEAR(way_m(-0.3, 1.0), -0.3 + 0.09, 1e-12);
  EXPECT_NEAR(way_m(0.0, 1.0), 0.0, 1e-12);
  EXPECT_GT(way_m(0.01, 1.0), 0.0);  // never backwards
}

TEST(Motion, CountedWheelsLoseNothingInCurves) {
  const OdometryCalibration loses{{0.0, 0.0, 0.0}, 0.09};
  MotionIncrement motion;
  motion.append(arc_step(0.3, 1.0, Eigen::Matrix2d::Zero()), loses);
  EXPECT_NEAR(motion.path_m, 0.3, 1e-12);
  EXPECT_TRUE(motion.per_calibration.col(3).isZero(0.0));
}

}  // namespace
}  // namespace roomwise::ekf
