// Wheels that are wrong by up to 10 %: does the filter find out, does the pose gain by it, and does
// it stay honest?
#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "services/ekf_svc/core/slam.h"
#include "tests/ekf_svc/experiment/experiments.h"
#include "tests/ekf_svc/support/corridor_world.h"

namespace roomwise::ekf {
namespace {

constexpr int kLaps = 3;
constexpr double kFoundWithin = 0.01;  // of the wheels' scale and of the turn's
constexpr double kRmseRatioMax = 0.5;  // of that with wheels believed that are wrong
constexpr double kNeesRatioMax = 1.1;  // honest whether the wheels are right or wrong

/// What wheels that are wrong like this report of a motion: the filter's correction undone.
MotionStep as_reported(const MotionIncrement& motion, const OdometryCalibration& truth) {
  MotionStep step = chord_step(
      {motion.translation_m.x(), motion.translation_m.y(), motion.turn_rad}, motion.covariance);
  step.twist = truth.correction().partialPivLu().solve(step.twist);
  return step;
}

struct Outcome {
  double mean_square_m2 = 0.0;
  double nees_ratio = 0.0;
  Eigen::Vector3d calibration_error = Eigen::Vector3d::Zero();
};

Outcome drive_with(const OdometryCalibration& truth, bool learns, std::uint64_t seed) {
  CorridorSettings settings;
  settings.classes = 4;
  CorridorWorld world(settings, seed);
  const Pose2 start = world.truth();
  EkfParams params;
  params.range_bias_m = params.lateral_bias_m = 0.0;
  params.self_calibration = learns;
  params.landmark_budget = 1000;
  Slam slam(params);
  Outcome outcome;
  const int steps = static_cast<int>(kLaps * world.lap_m() / settings.step_m);
  int instants = 0;
  for (int step = 1; step <= steps; ++step) {
    MotionIncrement motion;
    motion.append(as_reported(world.drive(), truth), slam.filter().calibration());
    slam.predict(motion);
    std::vector<Sighting> sightings;
    for (const auto& seen : world.look()) {
      sightings.push_back(seen.sighting);
      sightings.back().identity = seen.landmark;  // the odometry alone is on trial
    }
    std::vector<Verdict> verdicts(sightings.size());
    slam.process(sightings, true, verdicts);
    const Pose2 pose = slam.filter().pose();
    const Pose2 true_pose = compose(inverse(start), world.truth());
    const Eigen::Vector3d error(wrap_angle(true_pose.heading_rad - pose.heading_rad),
                                true_pose.x_m - pose.x_m, true_pose.y_m - pose.y_m);
    outcome.mean_square_m2 += error.tail<2>().squaredNorm() / steps;
    if (step % 200 != 0) continue;
    outcome.nees_ratio += error.dot(slam.filter().pose_covariance().ldlt().solve(error)) / 3.0;
    ++instants;
  }
  outcome.nees_ratio /= instants;
  outcome.calibration_error = slam.filter().calibration().value - truth.value;
  return outcome;
}

int count_worse(const std::vector<Outcome>& drives, const std::vector<Outcome>& than) {
  int worse = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].mean_square_m2 >= than[i].mean_square_m2) ++worse;
  }
  return worse;
}

struct Summary {
  double rmse_m = 0.0;
  double nees_ratio = 0.0;
  Eigen::Vector3d calibration_rms = Eigen::Vector3d::Zero();
};

Summary summary_of(const std::vector<Outcome>& outcomes) {
  Summary mean;
  double mean_square_m2 = 0.0;
  const auto count = static_cast<double>(outcomes.size());
  for (const Outcome& one : outcomes) {
    mean_square_m2 += one.mean_square_m2 / count;
    mean.nees_ratio += one.nees_ratio / count;
    mean.calibration_rms += one.calibration_error.cwiseAbs2() / count;
  }
  mean.rmse_m = std::sqrt(mean_square_m2);
  mean.calibration_rms = mean.calibration_rms.cwiseSqrt();
  return mean;
}

void print_row(const char* name, const Summary& summary) {
  const Eigen::Vector3d& rms = summary.calibration_rms;
  fmt::print("{:34} {:>8.3f} {:>8.2f} {:>12.2f} {:>12.2f} {:>14.4f}\n", name, summary.rmse_m,
             summary.nees_ratio, 100.0 * rms(0), 100.0 * rms(1), rms(2));
}

/// Drives with wheels that are right, or wrong by up to 10 %.
struct Drives {
  std::vector<Outcome> learning;
  std::vector<Outcome> trusting;
};

Drives drive_all(bool is_biased, int runs, int first_seed) {
  Drives drives;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int seed = first_seed; seed < first_seed + runs; ++seed) {
    OdometryCalibration truth;
    if (is_biased)
      truth.value << 0.1 * uniform(engine), 0.1 * uniform(engine), 0.04 * uniform(engine);
    drives.learning.push_back(drive_with(truth, true, static_cast<std::uint64_t>(seed)));
    drives.trusting.push_back(drive_with(truth, false, static_cast<std::uint64_t>(seed)));
  }
  return drives;
}

}  // namespace

int calibration_experiment(int runs, int first_seed) {
  fmt::print("{:34} {:>8} {:>8} {:>12} {:>12} {:>14}\n", "odometry", "RMSE m", "NEES/3",
             "distance %", "turn %", "pull rad/m");
  fmt::print("(the last three: RMS error of what is held of the wheels, over {} runs)\n", runs);
  const Drives right = drive_all(false, runs, first_seed);
  const Drives wrong = drive_all(true, runs, first_seed);
  const Summary right_learning = summary_of(right.learning);
  const Summary wrong_learning = summary_of(wrong.learning);
  const Summary wrong_trusting = summary_of(wrong.trusting);
  print_row("right, learning all the same", right_learning);
  print_row("right, believed", summary_of(right.trusting));
  print_row("up to 10 % wrong, learning", wrong_learning);
  print_row("up to 10 % wrong, believed", wrong_trusting);
  // Who knows how wrong the wheels are, exactly, drives as with right ones.
  fmt::print(
      "(worse than believing wrong wheels, by chance or not: {} drives learning, {} knowing"
      " exactly)\n",
      count_worse(wrong.learning, wrong.trusting), count_worse(right.trusting, wrong.trusting));
  const bool is_found = wrong_learning.calibration_rms.head<2>().maxCoeff() <= kFoundWithin;
  const bool is_better = wrong_learning.rmse_m <= kRmseRatioMax * wrong_trusting.rmse_m;
  const bool is_honest =
      std::max(right_learning.nees_ratio, wrong_learning.nees_ratio) <= kNeesRatioMax;
  return is_found && is_better && is_honest ? 0 : 1;
}

}  // namespace roomwise::ekf
