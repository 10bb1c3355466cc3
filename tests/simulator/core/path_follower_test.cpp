#include "services/simulator/core/path_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise::simulator {
namespace {

constexpr double kStep_s = 0.015;
constexpr double kBase_m = 0.235;

/// A differential drive whose wheels roll so much of what they are told.
Pose2 driven(const Pose2& pose, const LeftRight<double>& wheels_mps, double left_ratio,
             double right_ratio) {
  const double left_m = wheels_mps.left * left_ratio * kStep_s;
  const double right_m = wheels_mps.right * right_ratio * kStep_s;
  const double turn_rad = (right_m - left_m) / kBase_m;
  const double way_m = (left_m + right_m) / 2.0;
  return compose(pose, {way_m * std::cos(turn_rad / 2), way_m * std::sin(turn_rad / 2), turn_rad});
}

struct Ride {
  double farthest_m = 0.0;
  double fastest_wheel_mps = 0.0;
  Pose2 end;
  bool done = false;
};

Ride ride(const Pose2& from, double left_ratio, double right_ratio) {
  const Path square{"square", {{3.0, 0.0}, {3.0, 2.0}, {0.0, 2.0}}, 2};
  PathFollower follower(DrivePlan({0.0, 0.0, 0.5}, square), kBase_m);
  Ride result;
  result.end = from;
  for (int i = 0; i < 20000 && !follower.done(); ++i) {
    const auto wheels = follower.step(result.end, kStep_s);
    result.end = driven(result.end, wheels, left_ratio, right_ratio);
    const Pose2 goal = follower.plan().at(follower.plan_time_s()).pose;
    if (i > 1300) {  // 20 s to find the way
      result.farthest_m =
          std::max(result.farthest_m, (goal.position_m() - result.end.position_m()).norm());
    }
    result.fastest_wheel_mps =
        std::max({result.fastest_wheel_mps, std::abs(wheels.left), std::abs(wheels.right)});
  }
  result.done = follower.done();
  return result;
}

void expect_home(const Ride& result) {
  EXPECT_TRUE(result.done);
  EXPECT_NEAR(result.end.x_m, 0.0, 0.06);
  EXPECT_NEAR(result.end.y_m, 0.0, 0.06);
  EXPECT_NEAR(wrap_angle(result.end.heading_rad - 0.5), 0.0, 0.1);
}

TEST(PathFollower, KeepsToThePlanWithPerfectWheels) {
  const Ride result = ride({0.0, 0.0, 0.5}, 1.0, 1.0);
  EXPECT_LT(result.farthest_m, 0.015);
  expect_home(result);
}

TEST(PathFollower, KeepsToThePlanWithUnequalSlippingWheels) {
  const Ride result = ride({0.0, 0.0, 0.5}, 0.93, 0.98);
  EXPECT_LT(result.farthest_m, 0.06);
  expect_home(result);
}

TEST(PathFollower, FindsBackFromBesideTheStart) {
  const Ride result = ride({0.05, -0.15, 0.2}, 1.0, 1.0);
  EXPECT_LT(result.farthest_m, 0.03);
  expect_home(result);
}

TEST(PathFollower, WaitsForARobotThatIsHeld) {
  const Path line{"line", {{3.0, 0.0}}, 1};
  PathFollower follower(DrivePlan({}, line), kBase_m);
  for (int i = 0; i < 10000; ++i) std::ignore = follower.step({}, kStep_s);
  EXPECT_FALSE(follower.done());
  EXPECT_LT(follower.plan().at(follower.plan_time_s()).pose.x_m, 0.31);
}

TEST(PathFollower, KeepsWheelsWithinTheirSpeed) {
  EXPECT_LE(ride({-2.0, -3.0, 3.0}, 1.0, 1.0).fastest_wheel_mps, 0.5 + 1e-12);
}

}  // namespace
}  // namespace roomwise::simulator
