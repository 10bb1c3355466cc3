#include "logs/tools/covariance_ellipse.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/rwlog/poses.h"

namespace roomwise {
namespace {

RC_GTEST_PROP(CovarianceEllipse, EveryPointIsAtTheSameMahalanobisDistance, ()) {
  const Eigen::Matrix2d R = rotation2(*number_between(-3.0, 3.0));
  const Eigen::Vector2d variances(*number_between(0.01, 4.0), *number_between(0.01, 4.0));
  const Eigen::Matrix2d covariance = R * variances.asDiagonal() * R.transpose();
  const Eigen::Vector2d mean(1.0, -2.0);
  for (const Eigen::Vector2d& p : ellipse_outline(mean, covariance)) {
    const double d2 = (p - mean).dot(covariance.inverse() * (p - mean));
    RC_ASSERT(std::abs(d2 - 5.991) < 1e-9);
  }
}

TEST(CovarianceEllipse, IsEmptyForWhatIsNoCovariance) {
  const auto outline = [](double xx, double xy, double yy) {
    return ellipse_outline({0, 0}, (Eigen::Matrix2d() << xx, xy, xy, yy).finished());
  };
  EXPECT_TRUE(outline(-1, 0, 1).empty());
  EXPECT_TRUE(outline(1, 2, 1).empty());
  EXPECT_TRUE(outline(std::nan(""), 0, 1).empty());
  EXPECT_FALSE(outline(0, 0, 1).empty());
}

}  // namespace
}  // namespace roomwise
