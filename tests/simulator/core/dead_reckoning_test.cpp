// How far a Create by its wheels alone is off after a round of 40 m.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/simulator/core/create/body_sensors.h"
#include "services/simulator/core/robot_motion.h"

namespace roomwise::simulator {
namespace {

using Eigen::Vector2d;

constexpr double kWheelBase_m = 0.235;
constexpr double kTimeStep_s = 0.001;
constexpr int kStepsPerReading = 15;

/// What a host makes of the encoders with the nominal base and wheels.
class DeadReckoning {
 public:
  explicit DeadReckoning(const Pose2& start) : pose_(start) {}

  void read(const LeftRight<Wheel>& wheels) {
    const LeftRight<std::uint16_t> ticks{encoder_ticks(wheels.left.turned_m),
                                         encoder_ticks(wheels.right.turned_m)};
    const auto delta_m = [](std::uint16_t before, std::uint16_t after) {
      return static_cast<std::int16_t>(static_cast<std::uint16_t>(after - before)) *
             kTravelPerTick_m;
    };
    const double left_m = delta_m(ticks_.left, ticks.left);
    const double right_m = delta_m(ticks_.right, ticks.right);
    const double turn_rad = (right_m - left_m) / kWheelBase_m;
    const double mid_rad = pose_.heading_rad + turn_rad / 2.0;
    const double forward_m = (left_m + right_m) / 2.0;
    pose_ = {pose_.x_m + forward_m * std::cos(mid_rad), pose_.y_m + forward_m * std::sin(mid_rad),
             wrap_angle(pose_.heading_rad + turn_rad)};
    ticks_ = ticks;
  }
  const Pose2& pose() const { return pose_; }

 private:
  Pose2 pose_;
  LeftRight<std::uint16_t> ticks_;
};

/// Wheel speeds towards a point: turning in place first if it is far aside.
LeftRight<double> towards(const Pose2& pose, const Vector2d& goal_m) {
  const Vector2d to_goal = goal_m - pose.position_m();
  const double aside = wrap_angle(std::atan2(to_goal.y(), to_goal.x()) - pose.heading_rad);
  const double speed_mps = std::abs(aside) < 0.5 ? 0.3 : 0.0;
  const double turn_mps = std::clamp(0.25 * aside, -0.1, 0.1);
  return {speed_mps - turn_mps, speed_mps + turn_mps};
}

/// Position error where a round over `corners_m` ends, driven by the true pose.
double error_after_round_m(const std::vector<Vector2d>& corners_m, unsigned seed) {
  const Vector2d first = corners_m[1] - corners_m[0];
  const Pose2 start{corners_m[0].x(), corners_m[0].y(), std::atan2(first.y(), first.x())};
  RobotMotion robot(RobotParams{}, kWheelBase_m, start, std::mt19937_64(seed));
  DeadReckoning reckoned(start);
  for (std::size_t i = 1; i <= corners_m.size(); ++i) {
    const Vector2d goal_m = corners_m[i % corners_m.size()];
    while ((goal_m - robot.pose().position_m()).norm() > 0.05) {
      const LeftRight<double> command = towards(robot.pose(), goal_m);
      for (int k = 0; k < kStepsPerReading; ++k) robot.step({}, command, kTimeStep_s);
      reckoned.read(robot.wheels());
    }
  }
  return (reckoned.pose().position_m() - robot.pose().position_m()).norm();
}

struct Round {
  const char* name;
  std::vector<Vector2d> corners_m;
  friend void PrintTo(const Round& round, std::ostream* out) { *out << round.name; }
};

class DeadReckoningTest : public ::testing::TestWithParam<Round> {};

TEST_P(DeadReckoningTest, EndsAsFarOffAsARealCreate) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const double error_m = error_after_round_m(GetParam().corners_m, seed);
    EXPECT_GE(error_m, 0.3) << "seed " << seed;
    EXPECT_LE(error_m, 1.5) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rounds, DeadReckoningTest,
    ::testing::Values(Round{"square_left", {{0, 0}, {10, 0}, {10, 10}, {0, 10}}},
                      Round{"square_right", {{0, 0}, {10, 0}, {10, -10}, {0, -10}}},
                      Round{"corridor", {{0, 0}, {16, 0}, {16, 4}, {0, 4}}},
                      Round{"corridor_right", {{0, 0}, {16, 0}, {16, -4}, {0, -4}}}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace roomwise::simulator
