#include "services/ekf_svc/core/range_outliers.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr double kSigma_m = 0.1;  // of the range, landmark and pose known

/// Seen straight ahead at 3 m, `off_m` too far and `aside_m` to the left.
Residual residual_of(double off_m, double aside_m) {
  Residual residual;
  const double range_m = 3.0 + off_m;
  const Eigen::Vector2d seen(std::sqrt(range_m * range_m - aside_m * aside_m), aside_m);
  residual.innovation = seen - Eigen::Vector2d(3.0, 0.0);
  residual.noise = kSigma_m * kSigma_m * Eigen::Matrix2d::Identity();
  return residual;
}

Eigen::Matrix2d softening_of(const Residual& residual, double sigmas) {
  return range_softening(residual, Eigen::Vector2d(3.0, 0.0) + residual.innovation, residual.noise,
                         sigmas);
}

/// How hard a range pulls: what is off, by its variance.
double pull(double off_m, double sigmas) {
  const Residual residual = residual_of(off_m, 0.0);
  const Eigen::Matrix2d noise = residual.noise + softening_of(residual, sigmas);
  return residual.innovation.x() / noise(0, 0);
}

RC_GTEST_PROP(RangeOutliers, PullGrowsUpToSoManySigmasAndNoFarther, ()) {
  const double off_sigmas = 1e-3 * *rc::gen::inRange(0, 10'000);
  const double sigmas = 1e-3 * *rc::gen::inRange(100, 3'000);
  const double expected = std::min(off_sigmas, sigmas) / kSigma_m;
  RC_ASSERT(std::abs(pull(off_sigmas * kSigma_m, sigmas) - expected) < 1e-9 * (1.0 + expected));
}

RC_GTEST_PROP(RangeOutliers, ABearingPullsAsItDidWhateverTheRangeIs, ()) {
  const Residual residual = residual_of(1e-3 * *rc::gen::inRange(-900, 900), 0.0);
  RC_ASSERT(softening_of(residual, 1.0).col(1).isZero(1e-15));
}

TEST(RangeOutliers, ABearingFarOffSoftensNothingWhereTheRangeIsRight) {
  EXPECT_TRUE(softening_of(residual_of(0.0, 1.5), 1.0).isZero(0.0));
}

TEST(RangeOutliers, NoSigmasIsTheTextbookFilter) {
  EXPECT_TRUE(softening_of(residual_of(0.9, 0.0), 0.0).isZero(0.0));
}

}  // namespace
}  // namespace roomwise::ekf
