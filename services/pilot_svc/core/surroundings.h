#pragma once
#include <Eigen/Core>
#include <span>

#include "services/pilot_svc/core/obstacle_memory.h"
#include "services/pilot_svc/core/visit_memory.h"

namespace roomwise::pilot {

/// All that a behaviour steers by at one instant. Refers to the memories.
struct Surroundings {
  Time now{};
  Pose2 T_odom_robot;
  std::span<const Eigen::Vector2d> obstacles_robot_m;
  const ObstacleMemory& memory;
  const VisitMemory& visits;
};

}  // namespace roomwise::pilot
