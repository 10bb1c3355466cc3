#include "services/pilot_svc/core/go_to.h"

#include <algorithm>
#include <cmath>

#include "services/pilot_svc/core/wander.h"

namespace roomwise::pilot {
namespace {

constexpr double kNearer_m = 0.1;

}  // namespace

GoTo::GoTo(const Goal& goal, const PilotParams& params)
    : params_(params), speed_mps_(speed_of(goal, params)), choice_(params) {}

Step GoTo::step(const Surroundings& around, const Eigen::Vector2d& goal_odom_m) {
  const Eigen::Vector2d goal_m = transform(inverse(around.T_odom_robot), goal_odom_m);
  distance_m_ = goal_m.norm();
  if (first_m_ < 0.0) first_m_ = distance_m_;
  if (nearest_when_ == Time{} || distance_m_ < nearest_m_ - kNearer_m) {
    nearest_m_ = distance_m_;
    nearest_when_ = around.now;
  }
  if (distance_m_ <= params_.reached_m) return {.state = State::kDone};
  if (seconds(around.now - nearest_when_) > params_.no_nearer_s) {
    return {.state = State::kFailed, .failure = Failure::kNoWay};
  }
  const double toward_rad = std::atan2(goal_m.y(), goal_m.x());
  const auto direction = choice_.choose(
      around, {.reach_m = std::min(distance_m_, params_.reach_m), .toward_rad = toward_rad});
  if (!direction) return {.motion = {0.0, 0.6 * params_.turn_rate_radps}};
  const double ahead_m =
      std::min(free_way_m(around, 0.0, params_.robot_radius_m, params_), distance_m_ + 0.1);
  return {.motion = steer(direction->bearing_rad, ahead_m, speed_mps_, params_),
          .bearing_rad = direction->bearing_rad};
}

double GoTo::ratio() const {
  if (first_m_ <= 0.0) return 0.0;
  return std::clamp(1.0 - distance_m_ / first_m_, 0.0, 1.0);
}

}  // namespace roomwise::pilot
