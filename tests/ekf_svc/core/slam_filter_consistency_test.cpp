// Does the filter know how wrong it is? Average normalised estimation error squared (ANEES) of the
// pose over independent runs; divided by its 3 degrees of freedom it is 1 for an honest filter.
#include <gtest/gtest.h>

#include "tests/ekf_svc/support/filter_run.h"

namespace roomwise::ekf {
namespace {

constexpr int kRuns = 40;
constexpr int kSteps = 1000;          // about four rounds
constexpr int kInstantSpacing = 250;  // far apart, so that one instant does not repeat another
// 95 % of the means of 40 runs: chi^2 quantiles with 120 degrees of freedom, over 120.
constexpr double kBandLow = 0.763;
constexpr double kBandHigh = 1.268;

double pose_nees_ratio(const SlamFilter& filter, const Pose2& truth) {
  const Pose2 pose = filter.pose();
  const Eigen::Vector3d error(wrap_angle(truth.heading_rad - pose.heading_rad),
                              truth.x_m - pose.x_m, truth.y_m - pose.y_m);
  return error.dot(filter.pose_covariance().ldlt().solve(error)) / 3.0;
}

struct Anees {
  double invariant = 0.0;
  double plain = 0.0;
};

Anees simulate() {
  Anees sum;
  int count = 0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    WorldSettings settings;
    settings.turn_sigma_rad = 0.02;
    KnownIdentityRun run(settings, static_cast<std::uint64_t>(seed));
    SlamFilter invariant(ErrorForm::kInvariant, 60);
    SlamFilter plain(ErrorForm::kPlain, 60);
    for (int step = 1; step <= kSteps; ++step) {
      run.step({&invariant, &plain}, {});
      if (step % kInstantSpacing != 0) continue;
      sum.invariant += pose_nees_ratio(invariant, run.world().truth());
      sum.plain += pose_nees_ratio(plain, run.world().truth());
      ++count;
    }
  }
  return {sum.invariant / count, sum.plain / count};
}

TEST(SlamFilterConsistency, InvariantFilterIsHonestWhereThePlainOneIsTooSure) {
  const Anees anees = simulate();
  RecordProperty("anees_invariant", std::to_string(anees.invariant));
  RecordProperty("anees_plain", std::to_string(anees.plain));
  std::printf("ANEES/3 over %d runs: invariant %.3f, plain %.3f\n", kRuns, anees.invariant,
              anees.plain);
  EXPECT_GT(anees.invariant, kBandLow);
  EXPECT_LT(anees.invariant, kBandHigh);
  EXPECT_GT(anees.plain, kBandHigh);
}

}  // namespace
}  // namespace roomwise::ekf
