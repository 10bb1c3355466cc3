#include "services/pilot_svc/core/wander.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {

double speed_of(const Goal& goal, const PilotParams& params) {
  return goal.speed_mps > 0.0 ? std::min(goal.speed_mps, params.speed_mps) : params.speed_mps;
}

Wander::Wander(const Goal& goal, const PilotParams& params)
    : params_(params), speed_mps_(speed_of(goal, params)), choice_(params) {}

Step Wander::step(const Surroundings& around) {
  // A turn once begun is gone through with, whatever comes into view meanwhile.
  if (sense_ != 0.0) {
    if (const auto kept = choice_.kept(around)) return drive(around, *kept);
  }
  const auto direction = choice_.choose(around, {.reach_m = params_.reach_m, .toward_rad = {}});
  return direction ? drive(around, *direction) : look_about(around);
}

Step Wander::drive(const Surroundings& around, const Direction& direction) {
  // A turn to what lies behind may go either way round: once begun it is not turned about.
  const double turn_rad = std::abs(direction.bearing_rad);
  double bearing_rad = direction.bearing_rad;
  if (turn_rad > 2.0 && sense_ != 0.0) bearing_rad = sense_ * turn_rad;
  sense_ = turn_rad > params_.turn_on_spot_rad ? std::copysign(1.0, bearing_rad) : 0.0;
  const double radius_m = params_.robot_radius_m + params_.margin_tight_m;
  const double ahead_m = free_way_m(around, 0.0, radius_m, params_);
  return {.motion = steer(bearing_rad, ahead_m, speed_mps_, params_), .bearing_rad = bearing_rad};
}

Step Wander::look_about(const Surroundings& around) {
  if (sense_ == 0.0) {
    int more_on_right = 0;
    for (const Eigen::Vector2d& p_m : around.obstacles_robot_m)
      more_on_right += p_m.y() < 0.0 ? 1 : -1;
    sense_ = more_on_right >= 0 ? 1.0 : -1.0;
  }
  return {.motion = {0.0, 0.6 * sense_ * params_.turn_rate_radps}, .bearing_rad = sense_};
}

}  // namespace roomwise::pilot
