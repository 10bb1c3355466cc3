#pragma once
#include <Eigen/Core>
#include <vector>

#include "services/simulator/core/ground_plan.h"

namespace roomwise::simulator {

/// A body met by the round robot.
struct Touch {
  Eigen::Vector2d direction;  ///< unit, world frame, from the robot's centre to the body
  double gap_m = 0.0;         ///< between the two surfaces; negative: they overlap
};

/// Where a round robot of `radius_m` at `from_m` comes to rest when it wants to go to `wanted_m`:
/// it stops at what it meets and slides along it. Where it cannot be anywhere (squeezed between two
/// bodies) it stays at `from_m`; once a moving disc has overrun it there, only walls hold it. Needs
/// a way shorter than the radius, and `from_m` clear of the walls: then walls are never entered.
Eigen::Vector2d slide_to(const GroundPlan& plan, const Eigen::Vector2d& from_m,
                         const Eigen::Vector2d& wanted_m, double radius_m);

/// Replaces `touches` by every body of the plan nearer to the robot's rim than `reach_m`, walls
/// first, in the plan's order.
void find_touches(const GroundPlan& plan, const Eigen::Vector2d& center_m, double radius_m,
                  double reach_m, std::vector<Touch>& touches);

/// Way from `origin_m` along the unit vector `direction` to the first wall or disc; `longest_m` if
/// there is none nearer.
double free_way_m(const GroundPlan& plan, const Eigen::Vector2d& origin_m,
                  const Eigen::Vector2d& direction, double longest_m);

/// True if there is no floor under the point.
bool over_hole(const GroundPlan& plan, const Eigen::Vector2d& point_m);

/// Replaces `near` by the walls, discs and holes of `plan` within `reach_m` of the point: what a
/// robot that stays there can meet.
void keep_near(const GroundPlan& plan, const Eigen::Vector2d& point_m, double reach_m,
               GroundPlan& near);

}  // namespace roomwise::simulator
