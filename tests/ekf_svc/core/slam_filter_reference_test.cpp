// SlamFilter against full-matrix filters that share no code with it.
#include <gtest/gtest.h>

#include "tests/ekf_svc/support/filter_run.h"

namespace roomwise::ekf {
namespace {

WorldSettings full_view() {
  WorldSettings settings;
  settings.landmarks = 20;
  settings.half_view_rad = 3.2;
  settings.range_max_m = 4.0;
  settings.turn_sigma_rad = 0.02;
  settings.range_sigma_m = 0.05;
  settings.bearing_sigma_rad = 0.02;
  return settings;
}

void expect_equal(const SlamFilter& filter, const DenseFilter& dense, int step) {
  Eigen::VectorXd apart = state_of(filter) - dense.state();
  apart(0) = wrap_angle(apart(0));
  ASSERT_LT(apart.cwiseAbs().maxCoeff(), 1e-9) << "state, step " << step;
  const Eigen::MatrixXd P = dense.covariance();
  ASSERT_LT((covariance_of(filter) - P).cwiseAbs().maxCoeff(), 1e-9) << "covariance, step " << step;
}

TEST(SlamFilterReference, InvariantFormIsTheLieGroupFilter) {
  KnownIdentityRun run(full_view(), 1);
  SlamFilter filter(ErrorForm::kInvariant, 20);
  LieFilter lie;
  for (int step = 0; step < 2500; ++step) {
    run.step({&filter}, {&lie});
    if (step % 50 == 49) expect_equal(filter, lie, step);
  }
  EXPECT_EQ(filter.landmark_count(), 20U);
}

TEST(SlamFilterReference, PlainFormIsTheTextbookFilter) {
  KnownIdentityRun run(full_view(), 2);
  SlamFilter filter(ErrorForm::kPlain, 20);
  TextbookFilter textbook;
  for (int step = 0; step < 1000; ++step) {
    run.step({&filter}, {&textbook});
    if (step % 50 == 49) expect_equal(filter, textbook, step);
  }
  EXPECT_EQ(filter.landmark_count(), 20U);
}

TEST(SlamFilterReference, TheTwoFormsDiffer) {  // else the tests above would compare nothing
  KnownIdentityRun run(full_view(), 3);
  SlamFilter invariant(ErrorForm::kInvariant, 20);
  SlamFilter plain(ErrorForm::kPlain, 20);
  for (int step = 0; step < 300; ++step) run.step({&invariant, &plain}, {});
  EXPECT_GT((covariance_of(invariant) - covariance_of(plain)).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace roomwise::ekf
