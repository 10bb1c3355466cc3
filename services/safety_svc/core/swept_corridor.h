#pragma once
#include <Eigen/Core>

#include "services/safety_svc/core/obstacle_memory.h"
#include "services/safety_svc/core/safety_params.h"

namespace roomwise::safety {

/// What the robot would meet if it drove on along an arc.
struct CorridorView {
  double free_m = 0.0;   ///< way of the robot's centre until it must not go on
  double known_m = 0.0;  ///< way until the first place that is only overlooked; at most free_m
  double unknown_ratio = 0.0;  ///< share of the swept places that are unknown or overlooked
  Reason end =
      Reason::kAsAsked;  ///< what stands there; kAsAsked: nothing up to the length asked for
  Eigen::Vector2d p_robot_end_m = Eigen::Vector2d::Zero();  ///< where, in the robot's frame
};

/// Sweeps the robot's disc, with its margin, forward along an arc of `curvature_radpm` for
/// `length_m` (at most kReach_m), in steps of 2.5 cm. Places under the robot now, and those it
/// moves away from, do not count.
CorridorView sweep(const Instant& now, const ObstacleMemory& memory, const Pose2& T_odom_robot,
                   double curvature_radpm, double length_m, const SafetyParams& params);

}  // namespace roomwise::safety
