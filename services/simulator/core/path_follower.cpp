#include "services/simulator/core/path_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roomwise::simulator {
namespace {

constexpr double kArrived_m = 0.05;
constexpr double kArrived_rad = 0.05;
constexpr double kSettle_s = 1.0;

}  // namespace

PathFollower::PathFollower(DrivePlan plan, double wheel_base_m, const FollowerGains& gains)
    : plan_(std::move(plan)), wheel_base_m_(wheel_base_m), gains_(gains) {}

void PathFollower::advance(const Pose2& T_robot_goal, double dt_s) {
  const double away_m = T_robot_goal.position_m().norm();
  plan_s_ += dt_s * std::clamp(1.5 * (1.0 - away_m / gains_.patience_m), 0.0, 1.0);
  if (plan_s_ < plan_.duration_s()) return;
  settling_s_ += dt_s;
  const bool arrived = away_m < kArrived_m && std::abs(T_robot_goal.heading_rad) < kArrived_rad;
  done_ = done_ || arrived || settling_s_ > kSettle_s;
}

LeftRight<double> PathFollower::step(const Pose2& T_world_robot, double dt_s) {
  const DriveMoment goal = plan_.at(plan_s_);
  const Pose2 T_robot_goal = compose(inverse(T_world_robot), goal.pose);
  advance(T_robot_goal, dt_s);
  if (done_) return {};
  const double speed_mps =
      goal.speed_mps * std::cos(T_robot_goal.heading_rad) + gains_.along_per_s * T_robot_goal.x_m;
  const double turn_radps = goal.turn_radps +
                            goal.speed_mps * gains_.across_per_m2 * T_robot_goal.y_m +
                            gains_.heading_per_s * std::sin(T_robot_goal.heading_rad);
  const double half_turn_mps = turn_radps * wheel_base_m_ / 2.0;
  const double fastest_mps = std::abs(speed_mps) + std::abs(half_turn_mps);
  const double factor = std::min(1.0, gains_.largest_wheel_mps / std::max(fastest_mps, 1e-9));
  return {factor * (speed_mps - half_turn_mps), factor * (speed_mps + half_turn_mps)};
}

}  // namespace roomwise::simulator
