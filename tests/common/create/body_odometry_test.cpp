#include "common/create/body_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;

constexpr Time kBegin = time_from_utime(1'700'000'000'000'000);
constexpr double kDegree_rad = std::numbers::pi / 180.0;

/// A robot that says whole units as `rounding` says, and a driver that asks it every 150 ms.
struct Spin {
  Rounding rounding;
  double rate_degps;
};

double turned_deg(const Spin& spin, double expected_ratio) {
  const WheelGeometry geometry{.wheel_base_m = 0.258};
  BodyOdometry odometry(geometry, spin.rounding);
  const Duration period = milliseconds(150);
  Time time = kBegin;
  EXPECT_EQ(odometry.update(time, 0, 0), OdometryVerdict::kFirst);
  const double wheel_mps =
      0.5 * geometry.wheel_base_m * spin.rate_degps * kDegree_rad * expected_ratio;
  double carried_deg = 0.0;
  double sum_deg = 0.0;
  for (int i = 0; i < 1000; ++i) {
    time += period;
    carried_deg += spin.rate_degps * 0.15;
    const int reading = static_cast<int>(std::trunc(carried_deg));
    carried_deg = spin.rounding == Rounding::kCarry ? carried_deg - reading : 0.0;
    odometry.expect(period, -wheel_mps, wheel_mps);
    EXPECT_EQ(odometry.update(time, 0, reading), OdometryVerdict::kStep);
    sum_deg += odometry.step().turn_rad / kDegree_rad;
  }
  return sum_deg;
}

TEST(BodyOdometry, SlowTurnsThatReadAsNothingAreNotLost) {
  for (const Rounding rounding : {Rounding::kTruncate, Rounding::kCarry}) {
    for (const double rate_degps : {-5.0, 3.0, 17.0, 61.0, -90.0}) {
      EXPECT_NEAR(turned_deg({rounding, rate_degps}, 1.0), 150.0 * rate_degps, 1e-6);
    }
  }
}

TEST(BodyOdometry, AWrongExpectationIsBoundedByTheReadings) {
  // Asked for a third more than the wheels do: every truncated reading bounds the error by 1
  // degree, readings that carry bound the error of the whole drive.
  EXPECT_NEAR(turned_deg({Rounding::kTruncate, 40.0}, 1.33), 6000.0, 1000.0);
  EXPECT_NEAR(turned_deg({Rounding::kCarry, 40.0}, 1.33), 6000.0, 1.0);
}

TEST(BodyOdometry, AStalledRobotStaysWithinItsReading) {
  BodyOdometry odometry(WheelGeometry{}, Rounding::kCarry);
  Time time = kBegin;
  ASSERT_EQ(odometry.update(time, 0, 0), OdometryVerdict::kFirst);
  for (int i = 0; i < 100; ++i) {
    time += milliseconds(150);
    odometry.expect(milliseconds(150), 0.2, 0.2);
    ASSERT_EQ(odometry.update(time, 0, 0), OdometryVerdict::kStep);
  }
  EXPECT_LE(odometry.step().T_odom_robot.x_m, 0.001 + 1e-12);
}

TEST(BodyOdometry, ALostReadingIsBridgedWithLittleTrust) {
  BodyOdometry odometry(WheelGeometry{}, Rounding::kTruncate);
  ASSERT_EQ(odometry.update(kBegin, 0, 0), OdometryVerdict::kFirst);
  odometry.expect(milliseconds(150), 0.2, 0.2);
  odometry.reading_lost();
  odometry.expect(milliseconds(150), 0.2, 0.2);
  ASSERT_EQ(odometry.update(kBegin + milliseconds(300), 30, 0), OdometryVerdict::kStep);
  EXPECT_NEAR(odometry.step().distance_m, 0.06, 1e-9);
  EXPECT_GT(std::sqrt(odometry.step().covariance(0, 0)), 0.3 * 0.03);
}

TEST(BodyOdometry, UncertaintyOfTheTurnGrowsWithItsRateAndIsNoneAtRest) {
  BodyOdometry odometry(WheelGeometry{}, Rounding::kTruncate);
  ASSERT_EQ(odometry.update(kBegin, 0, 0), OdometryVerdict::kFirst);
  double last = -1.0;
  Time time = kBegin;
  for (const int angle_deg : {0, 1, 5, 20}) {
    time += milliseconds(150);
    odometry.expect(milliseconds(150), 0.0, 0.0);
    ASSERT_EQ(odometry.update(time, 0, angle_deg), OdometryVerdict::kStep);
    const double variance = odometry.step().covariance(1, 1);
    EXPECT_GT(variance, last);
    EXPECT_EQ(variance == 0.0, angle_deg == 0);
    last = variance;
  }
}

TEST(BodyOdometry, AbsurdReadingsStartAnew) {
  BodyOdometry odometry(WheelGeometry{}, Rounding::kTruncate);
  ASSERT_EQ(odometry.update(kBegin, 0, 0), OdometryVerdict::kFirst);
  EXPECT_EQ(odometry.update(kBegin + milliseconds(150), 32767, 0), OdometryVerdict::kJump);
  EXPECT_EQ(odometry.update(kBegin + milliseconds(300), 0, -32768), OdometryVerdict::kJump);
  EXPECT_EQ(odometry.update(kBegin + milliseconds(300), 0, 0), OdometryVerdict::kOutOfOrder);
}

}  // namespace
}  // namespace roomwise::create
