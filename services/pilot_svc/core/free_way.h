#pragma once
#include "services/pilot_svc/core/surroundings.h"

namespace roomwise::pilot {

/// How far a disc of `radius_m` can roll along `bearing_rad` until it touches one of the points, at
/// most `reach_m`. With point p at (x, y) along and beside the way: x - sqrt(radius^2 - y^2).
/// Points already inside the disc block only the half of the directions that lead toward them.
double swept_way_m(std::span<const Eigen::Vector2d> obstacles_robot_m, double bearing_rad,
                   double radius_m, double reach_m);

/// The same, and no farther than the way is known or within `params.blind_m`: unknown is not free.
double free_way_m(const Surroundings& around, double bearing_rad, double radius_m,
                  const PilotParams& params);

}  // namespace roomwise::pilot
