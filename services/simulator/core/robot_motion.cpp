#include "services/simulator/core/robot_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roomwise::simulator {
namespace {

/// Bodies nearer than this touch: a bumper gives way before its switch closes.
constexpr double kTouchReach_m = 0.0005;
/// A wheel that turns less than this share of what its motor wants is stalled.
constexpr double kStalledBelow = 0.5;
/// Length of floor over which a wheel slips alike.
constexpr double kSlipStretch_m = 0.01;

/// `value` between standing still and `full`.
double within(double full, double value) {
  return std::clamp(value, std::min(0.0, full), std::max(0.0, full));
}

/// What the two wheels roll when the centre moves only `allowed_m` forward: each gives up the same,
/// none turns against its motor.
LeftRight<double> hold_back(const LeftRight<double>& rolled_m, double allowed_m) {
  const double give_up_m = (rolled_m.left + rolled_m.right) / 2.0 - allowed_m;
  const double left_m = within(rolled_m.left, rolled_m.left - give_up_m);
  const double right_m = within(rolled_m.right, 2.0 * allowed_m - left_m);
  return {within(rolled_m.left, 2.0 * allowed_m - right_m), right_m};
}

double share_of(double part, double whole) { return whole == 0.0 ? 1.0 : part / whole; }

}  // namespace

RobotMotion::RobotMotion(const RobotParams& params, double nominal_base_m,
                         const Pose2& T_world_robot, std::mt19937_64 random)
    : params_(params),
      nominal_base_m_(nominal_base_m),
      T_world_robot_(T_world_robot),
      random_(random) {}

void RobotMotion::step(const GroundPlan& plan, const LeftRight<double>& command_mps, double dt_s) {
  wheels_.left.dropped = hangs(plan, nominal_base_m_ / 2.0);
  wheels_.right.dropped = hangs(plan, -nominal_base_m_ / 2.0);
  spin_up(wheels_.left, command_mps.left, dt_s);
  spin_up(wheels_.right, command_mps.right, dt_s);
  Travel share{1.0, 1.0};
  if (!wheels_.left.dropped && !wheels_.right.dropped) {
    const Travel rolled{rolled_m(wheels_.left, params_.left_wheel_ratio, dt_s),
                        rolled_m(wheels_.right, params_.right_wheel_ratio, dt_s)};
    const Travel moved = move_body(plan, rolled);
    share = {share_of(moved.left, rolled.left), share_of(moved.right, rolled.right)};
  }
  turn_wheel(wheels_.left, share.left, command_mps.left, dt_s);
  turn_wheel(wheels_.right, share.right, command_mps.right, dt_s);
  find_touches(plan, T_world_robot_.position_m(), params_.radius_m, kTouchReach_m, touches_);
}

/// Towards the commanded speed: through standing still when the direction changes.
void RobotMotion::spin_up(Wheel& wheel, double command_mps, double dt_s) const {
  const double target = std::clamp(command_mps, -params_.top_speed_mps, params_.top_speed_mps);
  const bool slows_down = wheel.speed_mps * (target - wheel.speed_mps) < 0.0;
  const double change = (slows_down ? params_.braking_mps2 : params_.acceleration_mps2) * dt_s;
  wheel.speed_mps += std::clamp(target - wheel.speed_mps, -change, change);
}

/// Slip is drawn anew for every stretch of floor: over many, its sum varies as slip_m2_per_m says.
double RobotMotion::rolled_m(Wheel& wheel, double wheel_ratio, double dt_s) {
  const double turned_m = wheel.speed_mps * dt_s;
  wheel.stretch_left_m -= std::abs(turned_m);
  if (wheel.stretch_left_m < 0.0) {
    const double sigma_ratio = std::sqrt(params_.slip_m2_per_m / kSlipStretch_m);
    wheel.slip_ratio = std::min(params_.slip_ratio + sigma_ratio * normal_(random_), 1.0);
    wheel.stretch_left_m = kSlipStretch_m;
  }
  return turned_m * wheel_ratio * (1.0 - wheel.slip_ratio);
}

RobotMotion::Travel RobotMotion::move_body(const GroundPlan& plan, const Travel& rolled_m) {
  const double base_m = nominal_base_m_ * params_.wheel_base_ratio;
  const double forward_m = (rolled_m.left + rolled_m.right) / 2.0;
  const double mid_rad =
      T_world_robot_.heading_rad + (rolled_m.right - rolled_m.left) / (2.0 * base_m);
  const Eigen::Vector2d ahead(std::cos(mid_rad), std::sin(mid_rad));
  const Eigen::Vector2d from_m = T_world_robot_.position_m();
  const Eigen::Vector2d to_m = slide_to(plan, from_m, from_m + forward_m * ahead, params_.radius_m);
  const bool free = to_m == from_m + forward_m * ahead;
  const Travel moved =
      free ? rolled_m : hold_back(rolled_m, within(forward_m, (to_m - from_m).dot(ahead)));
  T_world_robot_ = {to_m.x(), to_m.y(),
                    wrap_angle(T_world_robot_.heading_rad + (moved.right - moved.left) / base_m)};
  return moved;
}

void RobotMotion::turn_wheel(Wheel& wheel, double share, double command_mps, double dt_s) const {
  const bool stalled = share < kStalledBelow && command_mps != 0.0;
  wheel.turned_m += wheel.speed_mps * share * dt_s;
  if (stalled) wheel.speed_mps *= share;
  wheel.held_ratio = 1.0 - share;
  wheel.held_s = stalled ? wheel.held_s + dt_s : 0.0;
}

bool RobotMotion::hangs(const GroundPlan& plan, double side_m) const {
  return !plan.holes.empty() && over_hole(plan, transform(T_world_robot_, {0.0, side_m}));
}

}  // namespace roomwise::simulator
