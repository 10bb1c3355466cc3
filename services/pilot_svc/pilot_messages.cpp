#include "services/pilot_svc/pilot_messages.h"

#include <algorithm>
#include <initializer_list>
#include <limits>

namespace roomwise {
namespace {

const char* words_for(pilot::Failure failure) {
  switch (failure) {
    case pilot::Failure::kNone:
      return "";
    case pilot::Failure::kBadGoal:
      return "the goal cannot be meant";
    case pilot::Failure::kNoSegments:
      return "no SEGMENTS for too long";
    case pilot::Failure::kNoOdometry:
      return "no ODOMETRY for too long";
    case pilot::Failure::kNoPose:
      return "no POSE, or not tracking, for too long";
    case pilot::Failure::kStuck:
      return "stuck: recoveries used up";
    case pilot::Failure::kNoObject:
      return "nothing ahead to run around";
    case pilot::Failure::kObjectLost:
      return "lost the object";
    case pilot::Failure::kNoWay:
      return "came no nearer for too long";
  }
  return "";
}

bool has_any(const safety_state_t& message, std::initializer_list<std::int16_t> wanted) {
  return std::any_of(message.reasons.begin(), message.reasons.end(), [&](std::int16_t reason) {
    return std::find(wanted.begin(), wanted.end(), reason) != wanted.end();
  });
}

}  // namespace

pilot::Goal to_goal(const pilot_goal_t& message) {
  pilot::Goal goal{.speed_mps = message.goal_speed_mps,
                   .duration_s = message.goal_duration_s,
                   .x_m = message.goal_x_m,
                   .y_m = message.goal_y_m,
                   .circle_distance_m = message.circle_distance_m,
                   .circle_sense = message.circle_sense,
                   .circle_rounds = message.circle_rounds_ratio};
  const std::int8_t behaviour = message.behaviour;
  const bool is_known =
      behaviour >= pilot_goal_t::BEHAVIOUR_STOP && behaviour <= pilot_goal_t::BEHAVIOUR_GO_TO;
  goal.behaviour = is_known ? static_cast<pilot::Behaviour>(behaviour) : pilot::Behaviour::kWander;
  if (!is_known) goal.speed_mps = std::numeric_limits<double>::quiet_NaN();
  return goal;
}

pilot::Hold to_hold(const safety_state_t& message) {
  using Command = velocity_command_t;
  const bool is_held =
      message.state == safety_state_t::STATE_ESTOP ||
      has_any(message,
              {Command::REASON_ESTOP, Command::REASON_NO_CAMERA, Command::REASON_NO_ODOMETRY,
               Command::REASON_NO_CREATE_STATE, Command::REASON_CLOCK, Command::REASON_MODE,
               Command::REASON_WHEEL_DROP, Command::REASON_OVERCURRENT, Command::REASON_TILT,
               Command::REASON_CHARGING});
  if (is_held) return pilot::Hold::kHeld;
  const bool is_touched =
      has_any(message, {Command::REASON_BUMP, Command::REASON_CLIFF, Command::REASON_WALL});
  return is_touched ? pilot::Hold::kTouched : pilot::Hold::kNone;
}

pilot_state_t to_state_message(const pilot::Report& report) {
  pilot_state_t message{};
  message.behaviour = static_cast<std::int8_t>(report.behaviour);
  message.state = static_cast<std::int8_t>(report.state);
  message.failure = static_cast<std::int8_t>(report.failure);
  message.explanation =
      report.state == pilot::State::kWaiting ? report.waits_for : words_for(report.failure);
  message.progress_ratio = report.progress.ratio;
  message.goal_distance_m = report.progress.goal_distance_m;
  message.driven_m = report.driven_m;
  message.turned_about_object_rad = report.progress.turned_about_object_rad;
  message.object_distance_m = report.progress.object_distance_m;
  message.chosen_bearing_rad = report.bearing_rad;
  message.recoveries = report.recoveries;
  return message;
}

}  // namespace roomwise
