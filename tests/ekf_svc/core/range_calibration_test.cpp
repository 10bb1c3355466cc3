// Ranges that are wrong by where in the view they are taken.
#include "services/ekf_svc/core/range_calibration.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "services/ekf_svc/core/slam.h"

namespace roomwise::ekf {
namespace {

constexpr double kCalibrationSigma = 0.05;

PolarObservation polar(double range_m, double bearing_rad, double range_sigma_m = 0.02) {
  return {range_m, bearing_rad, Eigen::Vector2d(range_sigma_m * range_sigma_m, 1e-4).asDiagonal()};
}

SlamFilter filter_that_learns() {
  SlamFilter filter(ErrorForm::kInvariant, 8);
  filter.free_range_calibration(kCalibrationSigma);
  return filter;
}

TEST(RangeCalibration, ShapesAreOrthogonalAndOfNoMeanOverTheView) {
  constexpr int kSteps = 10'000;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double product = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = 2.0 * (i + 0.5) / kSteps - 1.0;
    const Eigen::Vector2d shape = RangeCalibration::shape(u * RangeCalibration::kHalfView_rad);
    mean += shape / kSteps;
    product += shape.x() * shape.y() / kSteps;
  }
  EXPECT_LT(mean.norm(), 1e-6);
  EXPECT_LT(std::abs(product), 1e-6);
  EXPECT_EQ(RangeCalibration::shape(2.0), RangeCalibration::shape(0.5));
}

TEST(RangeCalibration, HoldsADepthGivenForARange) {
  const RangeCalibration calibration{{0.0, -0.0805}};
  const double mean = std::sin(0.5) / 0.5;  // of the cosine over the view
  for (double bearing = -0.5; bearing <= 0.5; bearing += 0.05) {
    EXPECT_NEAR(calibration.ratio(bearing), std::cos(bearing) / mean, 0.006);
  }
}

TEST(RangeCalibration, JacobianIsTheNumericOne) {
  constexpr double kStep = 1e-6;
  const RangeCalibration held{{0.02, -0.06}};
  const PolarObservation seen = polar(2.5, 0.3);
  const BodyObservation body = to_body(seen, 0.0, 0.0, held);
  for (int k = 0; k < 2; ++k) {
    RangeCalibration more = held, less = held;
    more.value(k) += kStep, less.value(k) -= kStep;
    const Eigen::Vector2d by_held =
        (to_body(seen, 0.0, 0.0, more).p_robot_m - to_body(seen, 0.0, 0.0, less).p_robot_m) /
        (2.0 * kStep);
    EXPECT_LT((body.per_calibration.col(k) + by_held).norm(), 1e-8);  // innovation = - error held
  }
}

// What is wrong with a range is wrong with the next one from the same place too.
TEST(RangeCalibration, TheSameSightingAgainTellsNothingOfIt) {
  SlamFilter filter = filter_that_learns();
  const BodyObservation seen = to_body(polar(3.0, 0.4), 0.0, 0.0);
  ASSERT_TRUE(filter.add(seen, {}));
  const Residual again = filter.observation_residual(0, seen);
  EXPECT_LT((filter.innovation_covariance(again) - 2.0 * seen.covariance_m2).norm(), 1e-9);
  const Residual elsewhere = filter.observation_residual(0, to_body(polar(3.0, -0.4), 0.0, 0.0));
  EXPECT_GT(filter.innovation_covariance(elsewhere).trace(), 5.0 * seen.covariance_m2.trace());
  ASSERT_EQ(filter.update({&again, 1}), UpdateResult::kUsed);
  EXPECT_NEAR(filter.robot_covariance()(7, 7), kCalibrationSigma * kCalibrationSigma, 1e-9);
}

TEST(RangeCalibration, OfAFilterThatDoesNotLearnItStaysExact) {
  SlamFilter filter(ErrorForm::kInvariant, 8);
  const BodyObservation seen = to_body(polar(3.0, 0.4), 0.0, 0.0);
  ASSERT_TRUE(filter.add(seen, {}));
  const Residual residual = filter.observation_residual(0, to_body(polar(3.3, 0.4), 0.0, 0.0));
  ASSERT_EQ(filter.update({&residual, 1}), UpdateResult::kUsed);
  EXPECT_EQ(filter.range_calibration().value, Eigen::Vector2d::Zero());
  EXPECT_EQ(filter.robot_covariance()(8, 8), 0.0);
}

TEST(RangeCalibration, IsFreedByWhatRangesClaimButNotByOutlines) {
  constexpr std::int8_t kEdgeLeft = 1, kCrease = 3;
  Slam slam{EkfParams{}};
  for (const std::int8_t kind : {kEdgeLeft, kCrease}) {
    Sighting sighting;
    sighting.polar = polar(2.0, 0.1);
    sighting.kind = kind;
    std::vector<Verdict> verdicts(1);
    slam.process({&sighting, 1}, true, verdicts);
    EXPECT_EQ(slam.filter().robot_covariance()(7, 7) > 0.0, kind == kCrease);
  }
}

/// A robot goes three times round a ring of posts, and its camera gives depths for ranges.
struct Ring {
  static constexpr int kPosts = 12;
  std::mt19937_64 random{7};
  std::normal_distribution<double> normal;
  Slam slam;
  Pose2 truth{};
  double square_m2 = 0.0;
  int steps = 0;

  explicit Ring(const EkfParams& params) : slam(params) {}

  void drive() {
    constexpr double kStep_m = 0.05, kTurn_rad = kStep_m / 2.0;
    Eigen::Matrix2d covariance = Eigen::Vector2d(2e-4, 4e-4).asDiagonal();
    covariance *= kStep_m;
    const Eigen::Vector2d slip(std::sqrt(covariance(0, 0)) * normal(random),
                               std::sqrt(covariance(1, 1)) * normal(random));
    MotionIncrement meant, real;
    meant.append(arc_step(kStep_m, kTurn_rad, covariance), slam.filter().calibration());
    real.append(arc_step(kStep_m + slip.x(), kTurn_rad + slip.y(), covariance));
    truth = moved(truth, real);
    slam.predict(meant);
  }

  std::vector<Sighting> look() {
    std::vector<Sighting> sightings;
    for (int post = 0; post < kPosts; ++post) {
      const double at_rad = 2.0 * std::numbers::pi * post / kPosts;
      const Eigen::Vector2d p = transform(
          inverse(truth), Eigen::Vector2d(3.5 * std::cos(at_rad), 2.0 + 3.5 * std::sin(at_rad)));
      const double bearing_rad = std::atan2(p.y(), p.x());
      if (std::abs(bearing_rad) > 0.5 || p.norm() > 5.0) continue;
      sightings.push_back({.polar = polar(1.04 * p.x() + 0.02 * normal(random),
                                          bearing_rad + 0.01 * normal(random), 0.15),
                           .identity = post});
    }
    return sightings;
  }

  void run() {
    for (; steps < 750; ++steps) {
      drive();
      const std::vector<Sighting> sightings = look();
      std::vector<Verdict> verdicts(sightings.size());
      slam.process(sightings, true, verdicts);
      square_m2 += (slam.filter().pose().position_m() - truth.position_m()).squaredNorm();
    }
  }
};

TEST(RangeCalibration, IsLearnedWhileDrivingAndMakesThePathBetter) {
  EkfParams params;
  Ring learns(params);
  learns.run();
  params.range_calibration_sigmas = 0.0;
  Ring does_not(params);
  does_not.run();
  const Eigen::Vector2d learned = learns.slam.filter().range_calibration().value;
  EXPECT_NEAR(learned.x(), 0.0, 0.02);
  EXPECT_NEAR(learned.y(), -0.0805, 0.02);
  EXPECT_LT(learns.square_m2, 0.6 * does_not.square_m2);
}

}  // namespace
}  // namespace roomwise::ekf
