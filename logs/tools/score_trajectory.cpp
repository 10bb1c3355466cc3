#include "logs/tools/score_trajectory.h"

#include <cmath>

namespace roomwise {
namespace {

/// Estimated poses and the true ones of the same time.
struct PosePairs {
  std::vector<Pose2> estimate;
  std::vector<Pose2> truth;
};

PosePairs pair_up(const Trajectory& estimate, const Trajectory& truth) {
  PosePairs pairs;
  for (const TimedPose2& timed : estimate) {
    if (const auto true_pose = pose_at(truth, timed.utime)) {
      pairs.estimate.push_back(timed.pose);
      pairs.truth.push_back(*true_pose);
    }
  }
  return pairs;
}

Points2 positions_of(const std::vector<Pose2>& poses) {
  Points2 points;
  for (const Pose2& pose : poses) points.push_back(pose.position_m());
  return points;
}

double heading_rmse_rad(const PosePairs& pairs, double turn_rad) {
  double sum_rad2 = 0.0;
  for (std::size_t i = 0; i < pairs.truth.size(); ++i) {
    const double error_rad =
        wrap_angle(pairs.estimate[i].heading_rad + turn_rad - pairs.truth[i].heading_rad);
    sum_rad2 += error_rad * error_rad;
  }
  return std::sqrt(sum_rad2 / static_cast<double>(pairs.truth.size()));
}

}  // namespace

std::optional<TrajectoryScore> score_trajectory(const Trajectory& estimate,
                                                const Trajectory& truth) {
  const PosePairs pairs = pair_up(estimate, truth);
  if (pairs.truth.empty()) return std::nullopt;
  const Points2 estimated_m = positions_of(pairs.estimate);
  const Points2 true_m = positions_of(pairs.truth);
  TrajectoryScore score;
  score.poses = pairs.truth.size();
  score.T_world_map_raw = compose(pairs.truth.front(), inverse(pairs.estimate.front()));
  score.T_world_map_aligned = align_rigidly(estimated_m, true_m);
  score.ate_raw_m = rms_distance_m(score.T_world_map_raw, estimated_m, true_m);
  score.ate_aligned_m = rms_distance_m(score.T_world_map_aligned, estimated_m, true_m);
  score.heading_rmse_rad = heading_rmse_rad(pairs, score.T_world_map_aligned.heading_rad);
  return score;
}

}  // namespace roomwise
