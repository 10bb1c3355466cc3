#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "services/create_driver/core/calibration.h"

namespace roomwise::create {
namespace {

double within(double low, double high) {
  return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1'000'001);
}

/// A robot whose wheels are not what its parameters say.
WheelGeometry any_robot() {
  WheelGeometry robot;
  robot.wheel_base_m = within(0.22, 0.25);
  robot.wheel_diameter_m = within(0.070, 0.074);
  robot.left_scale_ratio = within(0.98, 1.02);
  robot.right_scale_ratio = 2.0 - robot.left_scale_ratio;
  return robot;
}

std::int64_t ticks(double travel_m, double scale_ratio, const WheelGeometry& robot) {
  return std::llround(travel_m / (robot.metres_per_tick() * scale_ratio));
}

/// What `robot` counts on an arc, and where the arc leads.
StraightRun drive(const WheelGeometry& robot, double length_m, double bend_rad) {
  const double outside_m = 0.5 * bend_rad * robot.wheel_base_m;
  StraightRun run;
  run.ticks = {ticks(length_m - outside_m, robot.left_scale_ratio, robot),
               ticks(length_m + outside_m, robot.right_scale_ratio, robot)};
  const Pose2 end = drive_arc({}, length_m, bend_rad);
  run.forward_m = end.x_m;
  run.left_m = end.y_m;
  return run;
}

SpinRun turn(const WheelGeometry& robot, double turn_rad) {
  const double rim_m = 0.5 * turn_rad * robot.wheel_base_m;
  return {.ticks = {ticks(-rim_m, robot.left_scale_ratio, robot),
                    ticks(rim_m, robot.right_scale_ratio, robot)},
          .turn_rad = turn_rad};
}

RC_GTEST_PROP(CalibrationLaw, TwoRunsTellTheWheelsOfAnyRobot, ()) {
  const WheelGeometry robot = any_robot();
  const StraightRun straight = drive(robot, 2.0, within(-0.2, 0.2));
  const SpinRun spin = turn(robot, 10.0 * std::numbers::pi + within(-0.3, 0.3));
  const auto found = calibrated(WheelGeometry{}, straight, spin);
  RC_ASSERT(found.has_value());
  const double left_m = found->wheel_diameter_m * found->left_scale_ratio;
  const double right_m = found->wheel_diameter_m * found->right_scale_ratio;
  // whole ticks: one in 4500 of the straight run, one in 8300 of the spin
  RC_ASSERT(std::abs(left_m / (robot.wheel_diameter_m * robot.left_scale_ratio) - 1.0) < 3e-4);
  RC_ASSERT(std::abs(right_m / (robot.wheel_diameter_m * robot.right_scale_ratio) - 1.0) < 3e-4);
  RC_ASSERT(std::abs(found->wheel_base_m / robot.wheel_base_m - 1.0) < 5e-4);
}

TEST(Calibration, KeepsTheNoiseItWasGiven) {
  WheelGeometry geometry;
  geometry.wheel_noise_m2_per_m = 7e-5;
  const auto found = calibrated(geometry, drive(geometry, 2.0, 0.0), turn(geometry, 31.4));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->wheel_noise_m2_per_m, 7e-5);
}

TEST(Calibration, MeasurementsOfNoCreateAreRefused) {
  const WheelGeometry robot;
  const StraightRun straight = drive(robot, 2.0, 0.0);
  const SpinRun spin = turn(robot, 31.4);
  EXPECT_FALSE(calibrated(robot, {straight.ticks, 4.0, 0.0}, spin));
  EXPECT_FALSE(calibrated(robot, {straight.ticks, 2.0, 1.0}, spin));
  EXPECT_FALSE(calibrated(robot, {{0, 0}, 2.0, 0.0}, spin));
  EXPECT_FALSE(calibrated(robot, straight, {spin.ticks, 0.0}));
  EXPECT_FALSE(calibrated(robot, straight, {spin.ticks, 20.0}));
  EXPECT_FALSE(calibrated(robot, straight, {{0, 0}, 31.4}));
  EXPECT_FALSE(calibrated(robot, {straight.ticks, 0.0, 0.0}, spin));
}

}  // namespace
}  // namespace roomwise::create
