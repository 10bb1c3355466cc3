#pragma once
#include <cstddef>
#include <optional>

#include "logs/tools/alignment.h"
#include "logs/tools/trajectory.h"

namespace roomwise {

/// How far an estimated trajectory is from the true one.
struct TrajectoryScore {
  std::size_t poses = 0;          ///< estimated poses that truth knows the time of
  double ate_raw_m = 0.0;         ///< RMS position error, the first such pose put on its true one
  double ate_aligned_m = 0.0;     ///< RMS position error after the best rigid alignment
  double heading_rmse_rad = 0.0;  ///< RMS heading error after that alignment
  Pose2 T_world_map_raw;          ///< the placement of each kind
  Pose2 T_world_map_aligned;
};

/// None if no estimated pose has a true one. (ATE: Sturm et al., "A benchmark for the evaluation of
/// RGB-D SLAM systems", IROS 2012, in the plane.)
std::optional<TrajectoryScore> score_trajectory(const Trajectory& estimate,
                                                const Trajectory& truth);

}  // namespace roomwise
