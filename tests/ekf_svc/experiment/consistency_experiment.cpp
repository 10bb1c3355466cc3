// Does the filter know how wrong it is? Average normalised estimation error squared (ANEES) of the
// pose over independent runs, divided by its 3 degrees of freedom: 1 for an honest filter.
#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "services/ekf_svc/core/chi_square.h"
#include "tests/ekf_svc/experiment/experiments.h"
#include "tests/ekf_svc/support/filter_run.h"

namespace roomwise::ekf {
namespace {

struct World {
  const char* name;
  WorldSettings settings;
  int steps;
  int instant_every;  // far apart, so that one instant does not repeat another
};

std::vector<World> consistency_worlds() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  WorldSettings full;
  full.landmarks = 40;
  full.half_view_rad = 3.2;
  full.range_max_m = 5.0;
  full.turn_sigma_rad = 1.0 * kDegree;
  full.range_sigma_m = 0.05;
  full.bearing_sigma_rad = 1.0 * kDegree;
  WorldSettings kinect;
  kinect.turn_sigma_rad = 1.0 * kDegree;
  // After Huang, Mourikis, Roumeliotis, IJRR 2010: 20 landmarks in full view of a robot that goes
  // round and round with 2 degrees of turn noise a step, range 10 % and bearing 1 degree.
  WorldSettings huang;
  huang.landmarks = 20;
  huang.course_radius_m = 4.0;
  huang.half_view_rad = 3.2;
  huang.range_max_m = 5.0;
  huang.step_m = 0.25;
  huang.distance_sigma_m = 0.0125;
  huang.turn_sigma_rad = 2.0 * kDegree;
  huang.range_sigma_m = 0.1;
  huang.bearing_sigma_rad = 1.0 * kDegree;
  return {{"full view", full, 1000, 250},
          {"57 degree view", kinect, 1000, 250},
          {"Huang's", huang, 1500, 500}};
}

double pose_nees_ratio_of(const SlamFilter& filter, const Pose2& truth) {
  const Pose2 pose = filter.pose();
  const Eigen::Vector3d error(wrap_angle(truth.heading_rad - pose.heading_rad),
                              truth.x_m - pose.x_m, truth.y_m - pose.y_m);
  return error.dot(filter.pose_covariance().ldlt().solve(error)) / 3.0;
}

struct Sums {
  double nees = 0.0;
  double square_m2 = 0.0;
  void add(const SlamFilter& filter, const Pose2& truth) {
    nees += pose_nees_ratio_of(filter, truth);
    square_m2 += (filter.pose().position_m() - truth.position_m()).squaredNorm();
  }
};

}  // namespace

int consistency_experiment(int runs, int first_seed) {
  const double low = chi_square_quantile(3 * runs, -kNormal975) / (3.0 * runs);
  const double high = chi_square_quantile(3 * runs, kNormal975) / (3.0 * runs);
  fmt::print("ANEES/3 of the pose, {} runs; an honest filter is within [{:.3f}, {:.3f}]\n", runs,
             low, high);
  fmt::print("{:18} {:>10} {:>10} {:>16} {:>12}\n", "world", "invariant", "plain",
             "invariant RMSE m", "plain RMSE m");
  bool as_promised = true;
  for (const World& world : consistency_worlds()) {
    Sums invariant_sum, plain_sum;
    int count = 0;
    for (int seed = first_seed; seed < first_seed + runs; ++seed) {
      KnownIdentityRun run(world.settings, static_cast<std::uint64_t>(seed));
      SlamFilter invariant(ErrorForm::kInvariant, 60);
      SlamFilter plain(ErrorForm::kPlain, 60);
      for (int step = 1; step <= world.steps; ++step) {
        run.step({&invariant, &plain}, {});
        if (step % world.instant_every != 0) continue;
        invariant_sum.add(invariant, run.world().truth());
        plain_sum.add(plain, run.world().truth());
        ++count;
      }
    }
    const double anees = invariant_sum.nees / count;
    const double plain_anees = plain_sum.nees / count;
    fmt::print("{:18} {:>10.3f} {:>10.3f} {:>16.3f} {:>12.3f}\n", world.name, anees, plain_anees,
               std::sqrt(invariant_sum.square_m2 / count), std::sqrt(plain_sum.square_m2 / count));
    as_promised = as_promised && anees > low && anees < high && plain_anees > high;
  }
  return as_promised ? 0 : 1;
}

}  // namespace roomwise::ekf
