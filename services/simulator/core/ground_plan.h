#pragma once
#include <Eigen/Core>
#include <vector>

namespace roomwise::simulator {

/// An upright face a wheeled robot can run into, from a to b. World frame.
struct PlanWall {
  Eigen::Vector2d a_m;
  Eigen::Vector2d b_m;
};

/// An upright cylinder: a table leg, a pillar, a person. World frame.
struct PlanDisc {
  Eigen::Vector2d center_m;
  double radius_m = 0.0;
};

/// A convex region without floor, corners counter-clockwise: stairs down. World frame.
struct PlanHole {
  std::vector<Eigen::Vector2d> corners_m;
};

/// What wheels, bumpers and cliff sensors meet of the world at one instant. There is floor at z = 0
/// wherever there is no hole.
struct GroundPlan {
  std::vector<PlanWall> walls;
  std::vector<PlanDisc> discs;
  std::vector<PlanHole> holes;
};

}  // namespace roomwise::simulator
