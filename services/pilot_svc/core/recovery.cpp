#include "services/pilot_svc/core/recovery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise::pilot {
namespace {

constexpr double kPlace_m = 0.05;
constexpr double kBackOff_mps = 0.08;
constexpr double kStop_s = 0.5;
constexpr double kBackOff_s = 3.0;  // safety_svc may not let it
constexpr double kTurn_s = 8.0;
constexpr double kElsewhere_m = 1.0;

}  // namespace

bool StuckWatch::is_stuck(Time now, const Pose2& T_odom_robot, const Motion& asked) {
  const Eigen::Vector2d at_m = T_odom_robot.position_m();
  if (!place_ || (at_m - *place_).norm() > kPlace_m) {
    place_ = at_m;
    since_ = still_since_ = now;
  }
  if (std::abs(asked.speed_mps) < 0.02) still_since_ = now;
  return seconds(now - still_since_) > params_.stuck_after_s ||
         seconds(now - since_) > 4.0 * params_.stuck_after_s;
}

bool Recovery::begin(Time now, const Pose2& T_odom_robot) {
  const bool is_elsewhere =
      !began_at_ || (began_at_->position_m() - T_odom_robot.position_m()).norm() > kElsewhere_m;
  in_a_row_ = is_elsewhere ? 1 : in_a_row_ + 1;
  if (in_a_row_ > params_.recoveries_max) return false;
  ++count_;
  if (is_elsewhere) began_at_ = T_odom_robot;
  const double turn_rad = (in_a_row_ % 2 == 1 ? 1.0 : -1.0) * in_a_row_ * std::numbers::pi / 2.0;
  heading_rad_ = wrap_angle(T_odom_robot.heading_rad + turn_rad);
  enter(Phase::kStop, now);
  return true;
}

void Recovery::enter(Phase phase, Time now) {
  phase_ = phase;
  entered_ = now;
}

Motion Recovery::step(Time now, const Pose2& T_odom_robot) {
  const double for_s = seconds(now - entered_);
  if (phase_ == Phase::kStop) {
    if (for_s >= kStop_s) enter(Phase::kBackOff, now);
    return {};
  }
  if (phase_ == Phase::kBackOff) {
    if (for_s >= std::min(kBackOff_s, params_.back_off_m / kBackOff_mps)) enter(Phase::kTurn, now);
    return {-kBackOff_mps, 0.0};
  }
  const double off_rad = wrap_angle(heading_rad_ - T_odom_robot.heading_rad);
  if (std::abs(off_rad) < 0.1 || for_s >= kTurn_s) enter(Phase::kOff, now);
  return steer(off_rad, 0.0, 0.0, params_);
}

}  // namespace roomwise::pilot
