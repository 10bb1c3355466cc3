#include "services/pilot_svc/core/free_way.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {
namespace {

double known_way_m(const Surroundings& around, double bearing_rad, double reach_m,
                   const PilotParams& params) {
  const double heading_rad = around.T_odom_robot.heading_rad + bearing_rad;
  const Eigen::Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
  int missing = 0;  // one cell between two rays may be missed by both
  for (double r = params.blind_m; r < reach_m; r += ObstacleMemory::kCell_m) {
    const Eigen::Vector2d p_odom_m = around.T_odom_robot.position_m() + r * direction;
    missing = around.memory.is_known(around.now, p_odom_m) ? 0 : missing + 1;
    if (missing == 3) return std::max(r - 2.0 * ObstacleMemory::kCell_m, params.blind_m);
  }
  return reach_m;
}

}  // namespace

double swept_way_m(std::span<const Eigen::Vector2d> obstacles_robot_m, double bearing_rad,
                   double radius_m, double reach_m) {
  const double c = std::cos(bearing_rad);
  const double s = std::sin(bearing_rad);
  double way_m = reach_m;
  for (const Eigen::Vector2d& p_m : obstacles_robot_m) {
    const double along_m = c * p_m.x() + s * p_m.y();
    const double beside_m = c * p_m.y() - s * p_m.x();
    if (along_m <= 0.0 || std::abs(beside_m) >= radius_m) continue;
    way_m = std::min(way_m, along_m - std::sqrt(radius_m * radius_m - beside_m * beside_m));
  }
  return std::max(way_m, 0.0);
}

double free_way_m(const Surroundings& around, double bearing_rad, double radius_m,
                  const PilotParams& params) {
  const double way_m = swept_way_m(around.obstacles_robot_m, bearing_rad, radius_m, params.reach_m);
  return known_way_m(around, bearing_rad, way_m, params);
}

}  // namespace roomwise::pilot
