#include "services/pilot_svc/core/circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/pilot_svc/core/free_way.h"
#include "services/pilot_svc/core/wander.h"

namespace roomwise::pilot {
namespace {

constexpr double kQuarter_rad = std::numbers::pi / 2.0;
constexpr double kLeanGain_radpm = 5.0;
constexpr double kLeanMax_rad = 0.8;
constexpr double kAhead_rad = 0.5;  // either side: what counts as ahead
constexpr double kOnCourse_rad = 0.2;
constexpr double kFirm_ratio = 1.5;     // of the turn gain, and ...
constexpr double kCareful_ratio = 0.6;  // of the speed: the band is narrow
constexpr double kLost_m = 1.0;         // farther than wanted: no longer round it

}  // namespace

Circle::Circle(const Goal& goal, const PilotParams& params)
    : params_(params),
      goal_(goal),
      speed_mps_(speed_of(goal, params)),
      sense_(goal.circle_sense > 0 ? 1.0 : -1.0) {
  params_.turn_gain_hz *= kFirm_ratio;
}

Step Circle::step(const Surroundings& around) {
  count_turn(around);
  if (phase_ == Phase::kApproach) return approach(around);
  if (phase_ == Phase::kLook) return look(around);
  return run_around(around);
}

double Circle::ratio() const {
  const double whole_rad = 2.0 * std::numbers::pi * goal_.circle_rounds;
  return std::clamp(sense_ * turned_rad_ / whole_rad, 0.0, 1.0);
}

void Circle::count_turn(const Surroundings& around) {
  const double heading_rad = around.T_odom_robot.heading_rad;
  const double turn_rad = wrap_angle(heading_rad - heading_rad_.value_or(heading_rad));
  (phase_ == Phase::kApproach ? searched_rad_ : turned_rad_) += turn_rad;
  heading_rad_ = heading_rad;
}

Step Circle::approach(const Surroundings& around) {
  const auto object_m = nearest(around, -kAhead_rad, kAhead_rad);
  if (!object_m) {
    if (std::abs(searched_rad_) > 2.0 * std::numbers::pi) {
      return {.state = State::kFailed, .failure = Failure::kNoObject};
    }
    return {.motion = {0.0, sense_ * 0.5 * params_.turn_rate_radps}};
  }
  searched_rad_ = 0.0;
  const double distance_m = object_m->norm() - params_.robot_radius_m;
  object_distance_m_ = distance_m;
  if (distance_m < goal_.circle_distance_m) {
    phase_ = Phase::kAround;
    looked_from_ = around.T_odom_robot;
    return {};
  }
  const double bearing_rad = std::atan2(object_m->y(), object_m->x());
  const double way_m = distance_m - goal_.circle_distance_m + 0.1;
  return {.motion = steer(bearing_rad, way_m, speed_mps_, params_), .bearing_rad = bearing_rad};
}

Step Circle::run_around(const Surroundings& around) {
  if (ratio() >= 1.0) return {.state = State::kDone};
  const auto object_m = nearest(around, -0.4, 2.8);
  const double wanted = params_.robot_radius_m + goal_.circle_distance_m;
  if (!object_m || object_m->norm() > wanted + kLost_m) {
    return {.state = State::kFailed, .failure = Failure::kObjectLost};
  }
  const double distance_m = object_m->norm();
  object_distance_m_ = std::max(distance_m - params_.robot_radius_m, 0.0);
  const double lean_rad = std::clamp(kLeanGain_radpm * (distance_m - wanted_m(around, distance_m)),
                                     -kLeanMax_rad, kLeanMax_rad);
  const double bearing_rad =
      wrap_angle(std::atan2(object_m->y(), object_m->x()) - sense_ * (kQuarter_rad - lean_rad));
  const bool is_on_course = std::abs(bearing_rad) < kOnCourse_rad;
  if (is_on_course && look_is_due(around)) begin_look(around);
  const double tight_m = params_.robot_radius_m + params_.margin_tight_m;
  const double way_m = swept_way_m(around.obstacles_robot_m, 0.0, tight_m, params_.reach_m);
  Motion motion = steer(bearing_rad, way_m, kCareful_ratio * speed_mps_, params_);
  motion.turn_rate_radps += sense_ * motion.speed_mps / std::max(distance_m, 0.2);
  return {.motion = motion, .bearing_rad = bearing_rad};
}

double Circle::wanted_m(const Surroundings& around, double object_m) const {
  // Of many cells that may be half a cell off the nearest is taken: that one lies too near.
  const double wanted =
      params_.robot_radius_m + goal_.circle_distance_m - 0.5 * ObstacleMemory::kCell_m;
  const auto other_m = nearest(around, -2.3, -0.7);
  if (!other_m) return wanted;
  return std::min(wanted, 0.5 * (object_m + other_m->norm()));
}

bool Circle::look_is_due(const Surroundings& around) const {
  const Pose2 since = compose(inverse(looked_from_), around.T_odom_robot);
  return since.position_m().norm() > params_.look_every_m ||
         std::abs(since.heading_rad) > params_.look_every_rad;
}

void Circle::begin_look(const Surroundings& around) {
  phase_ = Phase::kLook;
  looked_from_ = around.T_odom_robot;
  look_heading_rad_ = wrap_angle(around.T_odom_robot.heading_rad + sense_ * params_.look_turn_rad);
  looks_since_.reset();
}

Step Circle::look(const Surroundings& around) {
  const double off_rad = wrap_angle(look_heading_rad_ - around.T_odom_robot.heading_rad);
  if (!looks_since_ && std::abs(off_rad) < 0.05) looks_since_ = around.now;
  if (looks_since_ && seconds(around.now - *looks_since_) >= params_.look_s) {
    phase_ = Phase::kAround;
  }
  return {.motion = steer(off_rad, 0.0, 0.0, params_), .bearing_rad = off_rad};
}

std::optional<Eigen::Vector2d> Circle::nearest(const Surroundings& around, double from_rad,
                                               double to_rad) const {
  std::optional<Eigen::Vector2d> best_m;
  for (const Eigen::Vector2d& p_m : around.obstacles_robot_m) {
    const double toward_rad = sense_ * std::atan2(p_m.y(), p_m.x());
    if (toward_rad < from_rad || toward_rad > to_rad) continue;
    if (!best_m || p_m.squaredNorm() < best_m->squaredNorm()) best_m = p_m;
  }
  return best_m;
}

}  // namespace roomwise::pilot
