#include "services/simulator/core/robot_motion.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace roomwise::simulator {
namespace {

constexpr double kBase_m = 0.235;
constexpr double kStep_s = 0.001;

RobotParams exact_wheels() {
  RobotParams params;
  params.slip_ratio = 0.0;
  params.slip_m2_per_m = 0.0;
  params.left_wheel_ratio = 1.0;
  params.right_wheel_ratio = 1.0;
  params.wheel_base_ratio = 1.0;
  return params;
}

RobotMotion robot_at(const Pose2& pose, const RobotParams& params = exact_wheels(),
                     unsigned seed = 1) {
  return {params, kBase_m, pose, std::mt19937_64(seed)};
}

void drive(RobotMotion& robot, const GroundPlan& plan, double left_mps, double right_mps,
           double duration_s) {
  const int steps = static_cast<int>(std::lround(duration_s / kStep_s));
  for (int i = 0; i < steps; ++i) robot.step(plan, {left_mps, right_mps}, kStep_s);
}

GroundPlan wall_ahead(double x_m) {
  return {.walls = {{{x_m, -5.0}, {x_m, 5.0}}}, .discs = {}, .holes = {}};
}

TEST(RobotMotion, StraightAheadIsStraight) {
  RobotMotion robot = robot_at({});
  drive(robot, {}, 0.3, 0.3, 2.0);
  EXPECT_NEAR(robot.pose().x_m, robot.wheels().left.turned_m, 1e-9);
  EXPECT_NEAR(robot.pose().y_m, 0.0, 1e-12);
  EXPECT_NEAR(robot.pose().x_m, 0.6, 0.3 * 0.3 / (2.0 * 2.0) + 1e-3) << "less the start's ramp";
}

TEST(RobotMotion, OppositeWheelsTurnInPlace) {
  RobotMotion robot = robot_at({1.0, 2.0, 0.0});
  drive(robot, {}, -0.1, 0.1, 1.0);
  EXPECT_NEAR(robot.pose().x_m, 1.0, 1e-9);
  EXPECT_NEAR(robot.pose().y_m, 2.0, 1e-9);
  EXPECT_NEAR(robot.pose().heading_rad, 2.0 * robot.wheels().right.turned_m / kBase_m, 1e-9);
  EXPECT_GT(robot.pose().heading_rad, 0.5) << "right wheel ahead turns left";
}

RC_GTEST_PROP(RobotMotion, DeadReckoningIsExactWithoutSlip, ()) {
  RobotMotion robot = robot_at({});
  Pose2 reckoned;
  LeftRight<double> before;
  for (int leg = 0; leg < 5; ++leg) {
    const double left = *rc::gen::inRange(-500, 501) * 1e-3;
    const double right = *rc::gen::inRange(-500, 501) * 1e-3;
    for (int i = 0; i < 400; ++i) {
      robot.step({}, {left, right}, kStep_s);
      const LeftRight<double> now{robot.wheels().left.turned_m, robot.wheels().right.turned_m};
      const double forward = (now.left - before.left + now.right - before.right) / 2.0;
      const double turn = (now.right - before.right - now.left + before.left) / kBase_m;
      const double mid = reckoned.heading_rad + turn / 2.0;
      reckoned = {reckoned.x_m + forward * std::cos(mid), reckoned.y_m + forward * std::sin(mid),
                  wrap_angle(reckoned.heading_rad + turn)};
      before = now;
    }
  }
  RC_ASSERT((reckoned.position_m() - robot.pose().position_m()).norm() < 1e-9);
  RC_ASSERT(std::abs(wrap_angle(reckoned.heading_rad - robot.pose().heading_rad)) < 1e-9);
}

RC_GTEST_PROP(RobotMotion, SameSeedAndCommandsGiveTheSameBits, (unsigned seed)) {
  RobotMotion one = robot_at({}, RobotParams{}, seed);
  RobotMotion other = robot_at({}, RobotParams{}, seed);
  const GroundPlan plan = wall_ahead(0.3);
  for (RobotMotion* robot : {&one, &other}) drive(*robot, plan, 0.4, 0.3, 1.0);
  RC_ASSERT(one.pose().x_m == other.pose().x_m);
  RC_ASSERT(one.pose().heading_rad == other.pose().heading_rad);
  RC_ASSERT(one.wheels().left.turned_m == other.wheels().left.turned_m);
}

TEST(RobotMotion, WheelsAccelerateAndBrakeNoFasterThanTheyCan) {
  RobotParams params = exact_wheels();
  RobotMotion robot = robot_at({}, params);
  for (const double command : {0.5, -0.5, 0.0, 0.2, 9.9, -9.9}) {
    for (int i = 0; i < 500; ++i) {
      const double before = robot.wheels().left.speed_mps;
      robot.step({}, {command, command}, kStep_s);
      const double change = robot.wheels().left.speed_mps - before;
      const double limit = before * change < 0.0 ? params.braking_mps2 : params.acceleration_mps2;
      ASSERT_LE(std::abs(change), limit * kStep_s + 1e-12);
      ASSERT_LE(std::abs(robot.wheels().left.speed_mps), params.top_speed_mps);
    }
    EXPECT_NEAR(robot.wheels().left.speed_mps, std::clamp(command, -0.5, 0.5), 1e-12);
  }
}

TEST(RobotMotion, StopsWithinATenthOfASecondFromTopSpeed) {
  RobotMotion robot = robot_at({});
  drive(robot, {}, 0.5, 0.5, 1.0);
  drive(robot, {}, 0.0, 0.0, 0.101);
  EXPECT_EQ(robot.wheels().left.speed_mps, 0.0);
}

TEST(RobotMotion, AWallStopsBodyAndEncoders) {
  RobotMotion robot = robot_at({});
  const GroundPlan plan = wall_ahead(0.5);
  drive(robot, plan, 0.3, 0.3, 2.0);
  EXPECT_NEAR(robot.pose().x_m, 0.33, 1e-6);
  ASSERT_EQ(robot.touches().size(), 1U);
  const double turned_m = robot.wheels().left.turned_m;
  drive(robot, plan, 0.3, 0.3, 1.0);
  EXPECT_NEAR(robot.wheels().left.turned_m, turned_m, 1e-6);
  EXPECT_GT(robot.wheels().left.held_ratio, 0.99);
  EXPECT_NEAR(robot.wheels().left.held_s, 1.9, 0.3);
  drive(robot, plan, -0.3, -0.3, 0.5);
  EXPECT_LT(robot.pose().x_m, 0.25) << "it can back off";
  EXPECT_TRUE(robot.touches().empty());
  EXPECT_EQ(robot.wheels().left.held_s, 0.0);
}

TEST(RobotMotion, AGlancingWallIsSlidAlong) {
  RobotMotion robot = robot_at({0.0, 0.0, 1.2});  // the wall runs along 1.57
  const GroundPlan plan = wall_ahead(0.2);
  drive(robot, plan, 0.3, 0.3, 3.0);
  EXPECT_GT(robot.pose().y_m, 0.5);
  EXPECT_NEAR(robot.pose().x_m, 0.03, 1e-6);
  EXPECT_LT(robot.wheels().left.held_ratio, 0.5);
}

TEST(RobotMotion, ItCanTurnInPlaceAtAWall) {
  RobotMotion robot = robot_at({});
  const GroundPlan plan = wall_ahead(0.2);
  drive(robot, plan, 0.3, 0.3, 1.0);
  drive(robot, plan, 0.1, -0.1, 1.0);
  EXPECT_LT(robot.pose().heading_rad, -0.5);
}

TEST(RobotMotion, AWheelOverAHoleHangs) {
  RobotMotion robot = robot_at({});
  GroundPlan plan;
  plan.holes = {{{{0.3, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.3, 1.0}}}};
  drive(robot, plan, 0.3, 0.3, 5.0);
  EXPECT_NEAR(robot.pose().x_m, 0.3, 1e-3);
  EXPECT_TRUE(robot.wheels().left.dropped);
  EXPECT_TRUE(robot.wheels().right.dropped);
  EXPECT_GT(robot.wheels().left.turned_m, 1.0) << "a wheel in the air turns";
}

RC_GTEST_PROP(RobotMotion, BodyIsNeverInsideAWall, ()) {
  const GroundPlan plan{.walls = {{{-0.5, -0.5}, {0.5, -0.5}},
                                  {{0.5, -0.5}, {0.5, 0.5}},
                                  {{0.5, 0.5}, {-0.5, 0.5}},
                                  {{-0.5, 0.5}, {-0.5, -0.5}},
                                  {{0.2, 0.5}, {0.2, 0.3}}},
                        .discs = {},
                        .holes = {}};
  RobotMotion robot = robot_at({}, RobotParams{}, 7);
  std::vector<Touch> touches;
  for (int leg = 0; leg < 20; ++leg) {
    const double left = *rc::gen::inRange(-500, 501) * 1e-3;
    const double right = *rc::gen::inRange(-500, 501) * 1e-3;
    for (int i = 0; i < 300; ++i) {
      robot.step(plan, {left, right}, kStep_s);
      find_touches(plan, robot.pose().position_m(), 0.17, 0.0, touches);
      for (const Touch& touch : touches) RC_ASSERT(touch.gap_m > -1e-8);
    }
  }
}

RC_GTEST_PROP(RobotMotion, NoWheelEverTurnsAgainstItsMotor, ()) {
  const GroundPlan plan = wall_ahead(0.171);
  RobotMotion robot = robot_at({0.0, 0.0, *rc::gen::inRange(-1500, 1500) * 1e-3});
  const double left = *rc::gen::inRange(-500, 501) * 1e-3;
  const double right = *rc::gen::inRange(-500, 501) * 1e-3;
  LeftRight<double> before;
  for (int i = 0; i < 1000; ++i) {
    robot.step(plan, {left, right}, kStep_s);
    const LeftRight<double> now{robot.wheels().left.turned_m, robot.wheels().right.turned_m};
    RC_ASSERT((now.left - before.left) * left >= 0.0);
    RC_ASSERT((now.right - before.right) * right >= 0.0);
    before = now;
  }
}

}  // namespace
}  // namespace roomwise::simulator
