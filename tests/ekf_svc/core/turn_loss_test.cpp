// Speeds that were asked for lose in curves.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "services/ekf_svc/core/estimator.h"

namespace roomwise::ekf {
namespace {

constexpr Duration kFrameEvery = std::chrono::milliseconds(500);
constexpr double kLoss_m_per_rad = 0.09;

/// Half a metre straight on, then a quarter of a curve, alternately to the left twice and to the
/// right once; posts all around are seen.
struct CurvyDrive {
  Estimator estimator{EkfParams{}};
  Time time = time_from_utime(1'700'000'000'000'000);
  Pose2 truth{};
  std::mt19937_64 random{11};
  std::normal_distribution<double> normal;
  double error_m = 0.0;

  void go(double distance_m, double turn_rad, bool is_asked_for) {
    OdometrySample sample;
    sample.time = time += kFrameEvery;
    sample.interval = kFrameEvery;
    sample.distance_m = distance_m;
    sample.turn_rad = turn_rad;
    sample.covariance =
        Eigen::Vector2d(0.005 * distance_m, 0.01 * std::abs(turn_rad) + 1e-5).asDiagonal();
    sample.is_asked_for = is_asked_for;
    EXPECT_TRUE(is_used(estimator.add_odometry(sample)));
    MotionIncrement real;
    real.append(arc_step(distance_m - kLoss_m_per_rad * std::abs(turn_rad), turn_rad, {}));
    truth = moved(truth, real);
    look();
    error_m = (estimator.filter().pose().position_m() - truth.position_m()).norm();
  }

  void look() {
    std::vector<Sighting> sightings;
    for (int post = 0; post < 8; ++post) {
      const Eigen::Vector2d at(4.0 * std::cos(0.8 * post), 4.0 * std::sin(0.8 * post));
      const Eigen::Vector2d p = transform(inverse(truth), at);
      PolarObservation polar{
          p.norm() + 0.03 * normal(random), std::atan2(p.y(), p.x()) + 0.01 * normal(random), {}};
      polar.covariance = Eigen::Vector2d(9e-4, 1e-4).asDiagonal();
      sightings.push_back({.polar = polar, .identity = post});
    }
    std::vector<Verdict> verdicts(sightings.size());
    estimator.process(time, sightings, verdicts);
  }

  void run(bool is_asked_for) {
    for (int curve = 0; curve < 24; ++curve) {
      for (int i = 0; i < 10; ++i) go(0.05, 0.0, is_asked_for);
      const double turn_rad = curve % 3 == 2 ? -0.16 : 0.16;
      for (int i = 0; i < 10; ++i) go(0.05, turn_rad, is_asked_for);
    }
  }
};

TEST(TurnLoss, IsLearnedOfSpeedsThatWereAskedFor) {
  CurvyDrive drive;
  drive.run(true);
  const OdometryCalibration learned = drive.estimator.filter().calibration();
  EXPECT_NEAR(learned.turn_loss_m_per_rad, kLoss_m_per_rad, 0.015);
  EXPECT_NEAR(learned.distance_ratio(), 0.0, 0.03);
  EXPECT_LT(drive.error_m, 0.05);
}

TEST(TurnLoss, IsNoneOfWheelsThatCount) {
  CurvyDrive drive;
  drive.run(false);
  EXPECT_EQ(drive.estimator.filter().calibration().turn_loss_m_per_rad, 0.0);
}

}  // namespace
}  // namespace roomwise::ekf
