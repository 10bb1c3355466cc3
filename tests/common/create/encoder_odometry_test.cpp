#include "common/create/encoder_odometry.h"

#include <gtest/gtest.h>

#include <numbers>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kStart = time_from_utime(1'700'000'000'000'000);

EncoderOdometry started(std::uint16_t left = 0, std::uint16_t right = 0) {
  EncoderOdometry odometry(WheelGeometry{});
  EXPECT_EQ(odometry.update(kStart, left, right), OdometryVerdict::kFirst);
  return odometry;
}

TEST(EncoderOdometry, OneTurnOfBothWheelsIsTheirCircumference) {
  EncoderOdometry odometry = started(65500, 100);
  ASSERT_EQ(odometry.update(kStart + seconds(1), static_cast<std::uint16_t>(65500 + 509), 609),
            OdometryVerdict::kStep);
  EXPECT_NEAR(odometry.step().distance_m, std::numbers::pi * 0.072, 1e-4);
  EXPECT_EQ(odometry.step().turn_rad, 0.0);
  EXPECT_EQ(odometry.step().interval, seconds(1));
}

TEST(EncoderOdometry, RightWheelAheadTurnsLeft) {
  EncoderOdometry odometry = started();
  ASSERT_EQ(odometry.update(kStart + milliseconds(15), 0, 1), OdometryVerdict::kStep);
  EXPECT_NEAR(odometry.step().turn_rad, 0.108 * std::numbers::pi / 180.0, 1e-5);
}

TEST(EncoderOdometry, ScalesOfTheWheelsAreTheirOwn) {
  WheelGeometry geometry;
  geometry.left_scale_ratio = 0.99;
  geometry.right_scale_ratio = 1.02;
  EncoderOdometry odometry(geometry);
  ASSERT_EQ(odometry.update(kStart, 0, 0), OdometryVerdict::kFirst);
  ASSERT_EQ(odometry.update(kStart + seconds(1), 100, 100), OdometryVerdict::kStep);
  EXPECT_DOUBLE_EQ(odometry.step().wheel_left_m, 99.0 * geometry.metres_per_tick());
  EXPECT_DOUBLE_EQ(odometry.step().wheel_right_m, 102.0 * geometry.metres_per_tick());
}

TEST(EncoderOdometry, AStandingRobotAddsNoUncertainty) {
  EncoderOdometry odometry = started(7, 8);
  ASSERT_EQ(odometry.update(kStart + milliseconds(15), 7, 8), OdometryVerdict::kStep);
  EXPECT_TRUE(odometry.step().covariance.isZero(0.0));
}

TEST(EncoderOdometry, SilenceOfSomeSecondsLosesNothing) {
  EncoderOdometry odometry = started();
  ASSERT_EQ(odometry.update(kStart + seconds(5), 4000, 4000), OdometryVerdict::kStep);
  EXPECT_NEAR(odometry.step().distance_m, 4000 * 0.000444565, 1e-5);
}

TEST(EncoderOdometry, ALongGapStartsAnewAndSaysSo) {
  EncoderOdometry odometry = started();
  ASSERT_EQ(odometry.update(kStart + milliseconds(15), 10, 10), OdometryVerdict::kStep);
  EXPECT_EQ(odometry.update(kStart + seconds(60), 20, 20), OdometryVerdict::kGap);
  ASSERT_EQ(odometry.update(kStart + seconds(61), 30, 30), OdometryVerdict::kStep);
  EXPECT_EQ(odometry.step().reset_counter, 1);
  EXPECT_DOUBLE_EQ(odometry.step().T_odom_robot.x_m, odometry.step().distance_m);
}

TEST(EncoderOdometry, AJumpNoRobotCanDriveStartsAnew) {
  EncoderOdometry odometry = started(30000, 30000);
  EXPECT_EQ(odometry.update(kStart + milliseconds(15), 0, 0), OdometryVerdict::kJump);
  ASSERT_EQ(odometry.update(kStart + milliseconds(30), 5, 5), OdometryVerdict::kStep);
  EXPECT_EQ(odometry.step().reset_counter, 1);
}

TEST(EncoderOdometry, ReadingsOfOneInstantOrEarlierAreLeftOut) {
  EncoderOdometry odometry = started();
  EXPECT_EQ(odometry.update(kStart, 50, 50), OdometryVerdict::kOutOfOrder);
  EXPECT_EQ(odometry.update(kStart - milliseconds(1), 50, 50), OdometryVerdict::kOutOfOrder);
  ASSERT_EQ(odometry.update(kStart + milliseconds(15), 10, 10), OdometryVerdict::kStep);
  EXPECT_NEAR(odometry.step().distance_m, 10 * 0.000444565, 1e-7);
}

TEST(EncoderOdometry, RebasingBeforeAnythingMovedCountsOnce) {
  EncoderOdometry odometry = started();
  odometry.rebase();
  odometry.rebase();
  EXPECT_EQ(odometry.update(kStart + seconds(1), 500, 9), OdometryVerdict::kFirst);
  ASSERT_EQ(odometry.update(kStart + seconds(2), 500, 9), OdometryVerdict::kStep);
  EXPECT_EQ(odometry.step().reset_counter, 1);
}

}  // namespace
}  // namespace roomwise::create
