// Landmarks of unknown identity round a square corridor: does the robot keep its way, and does the
// map hold every landmark once?
#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "services/ekf_svc/core/slam.h"
#include "tests/ekf_svc/experiment/experiments.h"
#include "tests/ekf_svc/support/corridor_world.h"

namespace roomwise::ekf {
namespace {

constexpr double kLost_m = 1.0;  // error at the end
constexpr int kLaps = 2;

struct Outcome {
  double end_error_m = 0.0;
  double mean_square_m2 = 0.0;
  double nees_ratio = 0.0;  // of instants 20 m apart
  int merged = 0;
  int wrong_merges = 0;
  std::size_t landmarks = 0;
  double step_ms = 0.0;
};

/// Which true landmark each one of the map was begun by.
class Owners {
 public:
  void note(const Slam& slam, const std::vector<CorridorWorld::Seen>& seen,
            const std::vector<Verdict>& verdicts) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (verdicts[i] == Verdict::kAdded) owner_[next_id_++] = seen[i].landmark;
    }
    for (const Slam::Merged& merged : slam.merged()) {
      if (owner_[merged.recent_id] != owner_[merged.old_id]) ++wrong_;
    }
  }
  int wrong_merges() const { return wrong_; }

 private:
  std::map<std::int64_t, int> owner_;
  std::int64_t next_id_ = 1;
  int wrong_ = 0;
};

double nees_ratio_of(const SlamFilter& filter, const Pose2& truth) {
  const Pose2 pose = filter.pose();
  const Eigen::Vector3d error(wrap_angle(truth.heading_rad - pose.heading_rad),
                              truth.x_m - pose.x_m, truth.y_m - pose.y_m);
  return error.dot(filter.pose_covariance().ldlt().solve(error)) / 3.0;
}

EkfParams exact_noise() {
  EkfParams params;
  params.range_bias_m = params.lateral_bias_m = 0.0;
  params.self_calibration = false;
  params.landmark_budget = 600;
  return params;
}

Outcome drive(const CorridorSettings& settings, std::uint64_t seed) {
  CorridorWorld world(settings, seed);
  const Pose2 start = world.truth();
  Slam slam(exact_noise());
  Owners owners;
  Outcome outcome;
  std::vector<Sighting> sightings;
  std::vector<Verdict> verdicts;
  const int steps = static_cast<int>(kLaps * world.lap_m() / settings.step_m);
  int instants = 0;
  std::chrono::duration<double> spent{};
  for (int step = 1; step <= steps; ++step) {
    const MotionIncrement motion = world.drive();
    const auto seen = world.look();
    sightings.clear();
    for (const auto& one : seen) sightings.push_back(one.sighting);
    verdicts.resize(seen.size());
    const auto before = std::chrono::steady_clock::now();
    slam.predict(motion);
    const FrameResult result = slam.process(sightings, true, verdicts);
    spent += std::chrono::steady_clock::now() - before;
    owners.note(slam, seen, verdicts);
    outcome.merged += result.merged;
    const Pose2 truth = compose(inverse(start), world.truth());
    outcome.end_error_m = (slam.filter().pose().position_m() - truth.position_m()).norm();
    outcome.mean_square_m2 += outcome.end_error_m * outcome.end_error_m / steps;
    if (step % 200 != 0) continue;
    outcome.nees_ratio += nees_ratio_of(slam.filter(), truth);
    ++instants;
  }
  outcome.nees_ratio /= instants;
  outcome.wrong_merges = owners.wrong_merges();
  outcome.landmarks = slam.filter().landmark_count();
  outcome.step_ms = 1e3 * spent.count() / steps;
  return outcome;
}

struct World {
  std::string name;
  CorridorSettings settings;
  double wrong_merges_max;  // per run
};

std::vector<World> worlds() {
  const auto world = [](double spacing_m, int classes, double turn_deg) {
    CorridorSettings settings;
    settings.spacing_m = spacing_m;
    settings.classes = classes;
    settings.turn_sigma_rad = turn_deg * std::numbers::pi / 180.0;
    return settings;
  };
  std::vector<World> all{{"1.2 m apart, all alike", world(1.2, 1, 0.25), 0.05},
                         {"1.2 m apart, 4 classes", world(1.2, 4, 0.25), 0.03},
                         {"0.6 m apart, all alike", world(0.6, 1, 0.25), 0.05},
                         {"0.6 m apart, 4 classes", world(0.6, 4, 0.25), 0.03},
                         {"0.6 m, 4 classes, 0.5 degrees", world(0.6, 4, 0.5), 0.03},
                         {"1.2 m, alike, 10 % missed, clutter", world(1.2, 1, 0.25), 0.05}};
  all.back().settings.missed_ratio = 0.1;
  all.back().settings.clutter_per_frame = 0.2;
  return all;
}

}  // namespace

int association_experiment(int runs, int first_seed) {
  fmt::print("{:36} {:>6} {:>8} {:>8} {:>8} {:>9} {:>9} {:>8}\n", "world", "lost", "RMSE m",
             "NEES/3", "merges", "wrong", "landmarks", "ms/step");
  int failed = 0;
  for (const World& world : worlds()) {
    int lost = 0;
    Outcome sum;
    double landmarks = 0.0;
    for (int seed = first_seed; seed < first_seed + runs; ++seed) {
      const Outcome one = drive(world.settings, static_cast<std::uint64_t>(seed));
      if (one.end_error_m > kLost_m) ++lost;
      sum.mean_square_m2 += one.mean_square_m2 / runs;
      sum.nees_ratio += one.nees_ratio / runs;
      sum.merged += one.merged;
      sum.wrong_merges += one.wrong_merges;
      sum.step_ms += one.step_ms / runs;
      landmarks += static_cast<double>(one.landmarks) / runs;
    }
    const double wrong = static_cast<double>(sum.wrong_merges) / runs;
    fmt::print("{:36} {:>3}/{:<3}{:>8.3f} {:>8.2f} {:>8.1f} {:>9.3f} {:>9.1f} {:>8.3f}\n",
               world.name, lost, runs, std::sqrt(sum.mean_square_m2), sum.nees_ratio,
               static_cast<double>(sum.merged) / runs, wrong, landmarks, sum.step_ms);
    if (lost > 0 || wrong > world.wrong_merges_max) failed = 1;
  }
  return failed;
}

}  // namespace roomwise::ekf
