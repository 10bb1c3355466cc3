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

struct Scene;

/// Height of the robot's body: what hangs higher than this passes over it.
inline constexpr double kRobotHeight_m = 0.12;

/// What stands on the floor of `scene` within `height_m` above it, walkers where they are at `t_s`.
/// Walkers come last among the discs, in their order in the scene.
GroundPlan ground_plan(const Scene& scene, double t_s, double height_m = kRobotHeight_m);

/// Distance from `p_m` to the nearest wall, disc or hole; negative inside a disc or a hole.
/// Infinite in an empty plan.
double clearance_m(const GroundPlan& plan, const Eigen::Vector2d& p_m);

}  // namespace roomwise::simulator
