#include "services/simulator/core/ground_plan.h"

#include <algorithm>
#include <limits>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {
namespace {

template <class Body>
bool stands_within(const Body& body, double height_m) {
  return body.low_m < height_m && body.high_m > 0.0;
}

double distance_to_wall_m(const Eigen::Vector2d& a_m, const Eigen::Vector2d& b_m,
                          const Eigen::Vector2d& p_m) {
  const Eigen::Vector2d along = b_m - a_m;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? (p_m - a_m).dot(along) / squared : 0.0;
  return (p_m - a_m - along * std::clamp(share, 0.0, 1.0)).norm();
}

/// Negative inside.
double distance_to_region_m(const std::vector<Eigen::Vector2d>& corners_m,
                            const Eigen::Vector2d& p_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Eigen::Vector2d& a = corners_m[i];
    const Eigen::Vector2d& b = corners_m[(i + 1) % corners_m.size()];
    nearest_m = std::min(nearest_m, distance_to_wall_m(a, b, p_m));
    const Eigen::Vector2d along = b - a;
    inside = inside && along.x() * (p_m.y() - a.y()) - along.y() * (p_m.x() - a.x()) > 0.0;
  }
  return inside ? -nearest_m : nearest_m;
}

}  // namespace

GroundPlan ground_plan(const Scene& scene, double t_s, double height_m) {
  GroundPlan plan;
  for (const Block& block : scene.blocks) {
    if (!stands_within(block, height_m)) continue;
    const auto& corners = block.corners_m;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      plan.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
    }
  }
  for (const Column& column : scene.columns) {
    if (stands_within(column, height_m)) plan.discs.push_back({column.center_m, column.radius_m});
  }
  for (const Walker& walker : scene.walkers) {
    plan.discs.push_back({walker_pose(walker, t_s).position_m(), walker.radius_m});
  }
  for (const Pit& pit : scene.pits) plan.holes.push_back({pit.corners_m});
  return plan;
}

double clearance_m(const GroundPlan& plan, const Eigen::Vector2d& p_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const PlanWall& wall : plan.walls) {
    nearest_m = std::min(nearest_m, distance_to_wall_m(wall.a_m, wall.b_m, p_m));
  }
  for (const PlanDisc& disc : plan.discs) {
    nearest_m = std::min(nearest_m, (p_m - disc.center_m).norm() - disc.radius_m);
  }
  for (const PlanHole& hole : plan.holes) {
    nearest_m = std::min(nearest_m, distance_to_region_m(hole.corners_m, p_m));
  }
  return nearest_m;
}

}  // namespace roomwise::simulator
