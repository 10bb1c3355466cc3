#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "common/create/encoder_odometry.h"

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;

TEST(EncoderOdometryLaw, AnyTrueDifferenceBelowHalfTheRangeComesBackOverAMillionWraps) {
  std::mt19937 engine(2012);
  std::uniform_int_distribution<int> counts(-32767, 32767);
  std::int64_t truth = 0;
  std::int64_t added_up = 0;
  std::uint16_t before = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const int moved = counts(engine);
    truth += moved;
    const auto after = static_cast<std::uint16_t>(truth);
    const int delta = encoder_delta_ticks(before, after);
    ASSERT_EQ(delta, moved) << "from " << before << " to " << after;
    added_up += delta;
    before = after;
  }
  EXPECT_EQ(added_up, truth);
}

/// Readings every 15 ms that move each wheel by up to 20 ticks.
struct Drive {
  std::vector<std::pair<int, int>> moves;
};

Drive a_drive() {
  const auto ticks = rc::gen::inRange(-20, 21);
  return {*rc::gen::container<std::vector<std::pair<int, int>>>(rc::gen::pair(ticks, ticks))};
}

/// Where the robot is after `moves`, starting from counters `start`.
OdometryStep follow(const std::vector<std::pair<int, int>>& moves, std::uint16_t start) {
  EncoderOdometry odometry(WheelGeometry{});
  Time time = time_from_utime(1'000'000);
  auto left = start;
  auto right = start;
  RC_ASSERT(odometry.update(time, left, right) == OdometryVerdict::kFirst);
  for (const auto& [left_ticks, right_ticks] : moves) {
    time += milliseconds(15);
    left = static_cast<std::uint16_t>(left + left_ticks);
    right = static_cast<std::uint16_t>(right + right_ticks);
    RC_ASSERT(odometry.update(time, left, right) == OdometryVerdict::kStep);
  }
  return odometry.step();
}

RC_GTEST_PROP(EncoderOdometryLaw, ForwardThenTheSameWayBackEndsWhereItBegan, ()) {
  auto moves = a_drive().moves;
  for (auto i = static_cast<std::ptrdiff_t>(moves.size()) - 1; i >= 0; --i) {
    const auto [left, right] = moves[static_cast<std::size_t>(i)];
    moves.emplace_back(-left, -right);
  }
  const Pose2 pose = follow(moves, 65530).T_odom_robot;
  RC_ASSERT(std::abs(pose.x_m) < 1e-9);
  RC_ASSERT(std::abs(pose.y_m) < 1e-9);
  RC_ASSERT(std::abs(pose.heading_rad) < 1e-9);
}

RC_GTEST_PROP(EncoderOdometryLaw, WhereTheCountersStartDoesNotMatter, ()) {
  const auto moves = a_drive().moves;
  const Pose2 from_zero = follow(moves, 0).T_odom_robot;
  const Pose2 from_anywhere = follow(moves, *rc::gen::arbitrary<std::uint16_t>()).T_odom_robot;
  RC_ASSERT(from_zero.x_m == from_anywhere.x_m);
  RC_ASSERT(from_zero.y_m == from_anywhere.y_m);
  RC_ASSERT(from_zero.heading_rad == from_anywhere.heading_rad);
}

RC_GTEST_PROP(EncoderOdometryLaw, CovarianceIsPositiveSemidefinite, ()) {
  auto moves = a_drive().moves;
  moves.emplace_back(3, -7);
  const Eigen::Matrix2d covariance = follow(moves, 0).covariance;
  RC_ASSERT(covariance(0, 1) == covariance(1, 0));
  RC_ASSERT(covariance(0, 0) > 0.0);
  RC_ASSERT(covariance(0, 0) * covariance(1, 1) >= covariance(0, 1) * covariance(0, 1));
}

/// Both wheels at steady speeds drive a circle: the steps must lie on it, however it is cut.
RC_GTEST_PROP(EncoderOdometryLaw, StepsOfASteadyTurnLieOnOneCircle, ()) {
  const int left = *rc::gen::inRange(-17, 18);
  const int right = *rc::gen::inRange(-17, 18);
  RC_PRE(left != right);
  const std::size_t steps = *rc::gen::inRange<std::size_t>(1, 300);
  const Pose2 pose = follow({steps, {left, right}}, 0).T_odom_robot;
  const WheelGeometry geometry;
  const double radius_m = 0.5 * geometry.wheel_base_m * (left + right) / (right - left);
  const double turn_rad = static_cast<double>(steps) * (right - left) * geometry.metres_per_tick() /
                          geometry.wheel_base_m;
  RC_ASSERT(std::abs(pose.x_m - radius_m * std::sin(turn_rad)) < 1e-9);
  RC_ASSERT(std::abs(pose.y_m - radius_m * (1.0 - std::cos(turn_rad))) < 1e-9);
}

}  // namespace
}  // namespace roomwise::create
