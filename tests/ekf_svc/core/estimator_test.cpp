// Odometry and frames in time.
#include "services/ekf_svc/core/estimator.h"

#include <gtest/gtest.h>

#include <limits>

namespace roomwise::ekf {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(20);
const Time kStart = time_from_utime(1'700'000'000'000'000);

/// Wheels that never lie: reports of a robot going straight on at 0.5 m/s.
class Wheels {
 public:
  OdometrySample next(Duration interval = kTick) {
    OdometrySample sample;
    time_ += interval;
    x_m_ += 0.5 * seconds(interval);
    sample.time = time_;
    sample.interval = interval;
    sample.distance_m = 0.5 * seconds(interval);
    sample.covariance = 1e-6 * Eigen::Matrix2d::Identity();
    sample.T_odom_robot = {x_m_, 0.0, 0.0};
    return sample;
  }
  void jump(Duration by) { time_ += by; }

 private:
  Time time_ = kStart;
  double x_m_ = 0.0;
};

std::vector<Sighting> ahead(double range_m) {
  Sighting sighting;
  sighting.polar.range_m = range_m;
  sighting.polar.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  sighting.identity = 1;
  return {sighting};
}

class EstimatorTest : public testing::Test {
 protected:
  OdometryVerdict feed(int reports = 1) {
    OdometryVerdict verdict{};
    for (int i = 0; i < reports; ++i) verdict = estimator_.add_odometry(wheels_.next());
    return verdict;
  }
  FrameResult look(Time time, double range_m) {
    const auto sightings = ahead(range_m);
    std::vector<Verdict> verdicts(sightings.size());
    return estimator_.process(time, sightings, verdicts);
  }
  double sigma_x_m() const { return std::sqrt(estimator_.estimate().covariance(1, 1)); }

  Estimator estimator_{EkfParams{}};
  Wheels wheels_;
};

TEST_F(EstimatorTest, FirstReportIsTheMapsOrigin) {
  EXPECT_FALSE(estimator_.state() != Estimator::State::kStarting);
  EXPECT_EQ(estimator_.timing(kStart), FrameTiming::kNoOdometry);
  EXPECT_EQ(feed(), OdometryVerdict::kFirst);
  EXPECT_TRUE(estimator_.state() != Estimator::State::kStarting);
  EXPECT_EQ(estimator_.estimate().T_map_robot.x_m, 0.0);
  EXPECT_EQ(estimator_.estimate().time, kStart + kTick);
}

TEST_F(EstimatorTest, AFrameIsUsedWhereTheRobotWasWhenItWasTaken) {
  feed(11);                                                   // at 0.1 m
  look(kStart + kTick + std::chrono::milliseconds(50), 2.0);  // from 0.025 m
  EXPECT_NEAR(estimator_.filter().landmark_position_m(0).x(), 2.025, 1e-9);
  EXPECT_NEAR(estimator_.estimate().T_map_robot.x_m, 0.1, 1e-9);
}

TEST_F(EstimatorTest, FramesWaitAreLateOrComeFromAnotherClock) {
  feed(100);
  const Time now = estimator_.estimate().time;
  EXPECT_EQ(estimator_.timing(now), FrameTiming::kReady);
  EXPECT_EQ(estimator_.timing(now + kTick), FrameTiming::kWaits);
  EXPECT_EQ(estimator_.timing(now + std::chrono::seconds(2)), FrameTiming::kAheadOfBelief);
  EXPECT_EQ(estimator_.timing(now - std::chrono::seconds(1)), FrameTiming::kLate);
  EXPECT_EQ(estimator_.timing(Time::min()), FrameTiming::kLate);
  EXPECT_EQ(estimator_.timing(Time::max()), FrameTiming::kAheadOfBelief);
  look(now - kTick, 2.0);
  EXPECT_EQ(estimator_.timing(now - kTick), FrameTiming::kDuplicate);
  EXPECT_EQ(estimator_.timing(now - 2 * kTick), FrameTiming::kLate);
  EXPECT_THROW(look(now + kTick, 2.0), std::logic_error);
}

TEST_F(EstimatorTest, LostReportsAreBridgedByTheOdometryPoseAndWidenIt) {
  feed(50);
  const double sigma = sigma_x_m();
  for (int i = 0; i < 49; ++i) wheels_.next();
  EXPECT_EQ(feed(), OdometryVerdict::kGap);
  EXPECT_NEAR(estimator_.estimate().T_map_robot.x_m, 49 * 0.01 + 50 * 0.01, 1e-9);
  EXPECT_GT(sigma_x_m(), sigma + 0.05);
}

TEST_F(EstimatorTest, AResetCounterBreaksTheBridge) {
  feed(50);
  const double x = estimator_.estimate().T_map_robot.x_m;
  for (int i = 0; i < 49; ++i) wheels_.next();
  OdometrySample sample = wheels_.next();
  sample.reset_counter = 1;
  sample.T_odom_robot = {};
  EXPECT_EQ(estimator_.add_odometry(sample), OdometryVerdict::kGap);
  EXPECT_NEAR(estimator_.estimate().T_map_robot.x_m, x + 0.01, 1e-9);
}

TEST_F(EstimatorTest, AResetWithoutAGapChangesNothing) {
  feed(50);
  const double x = estimator_.estimate().T_map_robot.x_m;
  OdometrySample sample = wheels_.next();
  sample.reset_counter = 7;
  sample.T_odom_robot = {};
  EXPECT_EQ(estimator_.add_odometry(sample), OdometryVerdict::kUsed);
  EXPECT_NEAR(estimator_.estimate().T_map_robot.x_m, x + 0.01, 1e-9);
}

TEST_F(EstimatorTest, OldAndRepeatedReportsAreRefused) {
  feed(10);
  const PoseEstimate before = estimator_.estimate();
  Wheels old;
  EXPECT_EQ(estimator_.add_odometry(old.next()), OdometryVerdict::kOutOfOrder);
  OdometrySample again = wheels_.next();
  again.time = before.time;
  EXPECT_EQ(estimator_.add_odometry(again), OdometryVerdict::kOutOfOrder);
  EXPECT_EQ(estimator_.estimate().time, before.time);
  EXPECT_EQ(estimator_.estimate().covariance, before.covariance);
}

TEST_F(EstimatorTest, OneReportFromTheFutureDoesNotStopTheClock) {
  feed(10);
  OdometrySample sample = wheels_.next();
  sample.time += std::chrono::hours(1);
  EXPECT_EQ(estimator_.add_odometry(sample), OdometryVerdict::kOutOfOrder);
  EXPECT_EQ(feed(), OdometryVerdict::kGap);  // the refused one is missing
  EXPECT_EQ(feed(), OdometryVerdict::kUsed);
}

TEST_F(EstimatorTest, AClockThatWasSetIsFollowed) {
  for (const Duration by : {Duration(-std::chrono::hours(1)), Duration(std::chrono::hours(2))}) {
    feed(10);
    const double sigma = sigma_x_m();
    wheels_.jump(by);
    EXPECT_EQ(feed(4), OdometryVerdict::kOutOfOrder);
    EXPECT_EQ(feed(), OdometryVerdict::kRestarted);
    EXPECT_EQ(feed(), OdometryVerdict::kUsed);
    EXPECT_GT(sigma_x_m(), sigma);
  }
}

TEST_F(EstimatorTest, ReportsThatCannotBeAreRefusedByName) {
  feed(10);
  const PoseEstimate before = estimator_.estimate();
  const auto refused = [&](auto spoil) {
    Wheels copy = wheels_;
    OdometrySample sample = copy.next();
    spoil(sample);
    return estimator_.add_odometry(sample);
  };
  using enum OdometryVerdict;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused([](auto& s) { s.distance_m = kNan; }), kNotFinite);
  EXPECT_EQ(refused([](auto& s) { s.covariance(1, 0) = kNan; }), kNotFinite);
  EXPECT_EQ(refused([](auto& s) { s.distance_m = 1e300; }), kTooFast);
  EXPECT_EQ(refused([](auto& s) { s.turn_rad = -50.0; }), kTooFast);
  EXPECT_EQ(refused([](auto& s) { s.covariance(0, 0) = -1.0; }), kCovarianceInvalid);
  EXPECT_EQ(refused([](auto& s) { s.covariance(0, 1) = 1.0; }), kCovarianceInvalid);
  EXPECT_EQ(refused([](auto& s) { s.covariance(1, 1) = 1e300; }), kCovarianceInvalid);
  EXPECT_EQ(refused([](auto& s) { s.interval = Duration(0); }), kTimeInvalid);
  EXPECT_EQ(refused([](auto& s) { s.interval = Duration::max(); }), kTimeInvalid);
  EXPECT_EQ(refused([](auto& s) { s.time = Time::max(); }), kTimeInvalid);
  EXPECT_EQ(refused([](auto& s) { s.time = Time::min(); }), kTimeInvalid);
  EXPECT_EQ(estimator_.estimate().covariance, before.covariance);
  EXPECT_EQ(feed(), kUsed);
}

TEST_F(EstimatorTest, AParkedRobotDoesNotGetSurer) {
  feed(10);
  look(estimator_.estimate().time, 2.0);
  feed(10);
  look(estimator_.estimate().time, 1.9);
  const Eigen::Matrix2d known = estimator_.filter().landmark_covariance_m2(0);
  OdometrySample still = wheels_.next();
  still.distance_m = 0.0;
  still.covariance.setZero();
  FrameResult last;
  double after_2_s = 0.0;
  for (int i = 0; i < 500; ++i) {
    still.time += kTick;
    ASSERT_TRUE(is_used(estimator_.add_odometry(still)));
    last = look(still.time, 1.9);
    if (i == 100) after_2_s = estimator_.filter().landmark_covariance_m2(0).trace();
  }
  EXPECT_EQ(last.matched, 0);
  EXPECT_LT(after_2_s, known.trace());  // two more looks are welcome ...
  EXPECT_EQ(estimator_.filter().landmark_covariance_m2(0).trace(), after_2_s);  // ... not 500
}

}  // namespace
}  // namespace roomwise::ekf
