#include "services/pilot_svc/core/direction_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise::pilot {
namespace {

constexpr int kDirections = 72;
constexpr double kDirectionStep_rad = 2.0 * std::numbers::pi / kDirections;

double freshness_along(const Surroundings& around, const Direction& direction, double fades_s) {
  const double heading_rad = around.T_odom_robot.heading_rad + direction.bearing_rad;
  const Eigen::Vector2d unit(std::cos(heading_rad), std::sin(heading_rad));
  double sum = 0.0;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    const Eigen::Vector2d p_m = around.T_odom_robot.position_m() + share * direction.way_m * unit;
    sum += around.visits.freshness(around.now, p_m, fades_s);
  }
  return 0.25 * sum;
}

}  // namespace

std::optional<Direction> DirectionChoice::choose(const Surroundings& around,
                                                 const Preference& preference) {
  if (const auto straight = straight_on(around, preference)) {
    kept_heading_rad_.reset();
    return straight;
  }
  auto best = best_of(around, preference, params_.robot_radius_m + params_.margin_m);
  if (!best) best = best_of(around, preference, params_.robot_radius_m + params_.margin_tight_m);
  kept_heading_rad_.reset();
  if (best) kept_heading_rad_ = wrap_angle(around.T_odom_robot.heading_rad + best->bearing_rad);
  return best;
}

std::optional<Direction> DirectionChoice::kept(const Surroundings& around) const {
  if (!kept_heading_rad_) return std::nullopt;
  const double bearing_rad = wrap_angle(*kept_heading_rad_ - around.T_odom_robot.heading_rad);
  const double radius_m = params_.robot_radius_m + params_.margin_tight_m;
  const double way_m = free_way_m(around, bearing_rad, radius_m, params_);
  if (way_m < params_.way_min_m) return std::nullopt;
  return Direction{bearing_rad, way_m};
}

std::optional<Direction> DirectionChoice::straight_on(const Surroundings& around,
                                                      const Preference& preference) const {
  if (!preference.toward_rad) return std::nullopt;
  const double radius_m = params_.robot_radius_m + params_.margin_tight_m;
  const double way_m = free_way_m(around, *preference.toward_rad, radius_m, params_);
  if (way_m < std::min(preference.reach_m, params_.blind_m)) return std::nullopt;
  return Direction{*preference.toward_rad, way_m};
}

std::optional<Direction> DirectionChoice::best_of(const Surroundings& around,
                                                  const Preference& preference,
                                                  double radius_m) const {
  const double way_min_m = std::min(params_.way_min_m, preference.reach_m);
  // Directions lie still in the odom frame: while the robot turns, a kept one stays the same one.
  const double first_rad = kept_heading_rad_.value_or(around.T_odom_robot.heading_rad +
                                                      preference.toward_rad.value_or(0.0));
  std::optional<Direction> best;
  double best_score = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    const double bearing_rad =
        wrap_angle(first_rad + k * kDirectionStep_rad - around.T_odom_robot.heading_rad);
    const Direction direction{bearing_rad, free_way_m(around, bearing_rad, radius_m, params_)};
    if (direction.way_m < way_min_m) continue;
    const double bonus = k == 0 && kept_heading_rad_ ? params_.keep_bonus_ratio : 0.0;
    const double value = score(around, preference, direction) + bonus;
    if (best && value <= best_score) continue;
    best = direction;
    best_score = value;
  }
  return best;
}

double DirectionChoice::score(const Surroundings& around, const Preference& preference,
                              const Direction& direction) const {
  const double way = std::min(direction.way_m, preference.reach_m) / preference.reach_m;
  const double turn = std::abs(direction.bearing_rad) / std::numbers::pi;
  const double stale = freshness_along(around, direction, params_.visit_fades_s);
  const double plain = way - params_.turn_cost_ratio * turn - params_.visit_cost_ratio * stale;
  if (!preference.toward_rad) return plain;
  const double off = std::abs(wrap_angle(direction.bearing_rad - *preference.toward_rad));
  return way - params_.turn_cost_ratio * turn - 0.5 * params_.visit_cost_ratio * stale - off;
}

}  // namespace roomwise::pilot
