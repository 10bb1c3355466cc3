#pragma once
#include <Eigen/Core>
#include <optional>

#include "common/channels.h"
#include "services/pilot_svc/core/pilot.h"

namespace roomwise {

/// PILOT_GOAL as the core takes it; an unknown behaviour becomes a goal that is not sound.
pilot::Goal to_goal(const pilot_goal_t& message);

/// What SAFETY_STATE means for a behaviour.
pilot::Hold to_hold(const safety_state_t& message);

/// Where safety_svc lets the robot not go though asked to, in the robot's frame; nothing if it lets
/// it go, or for another reason.
std::optional<Eigen::Vector2d> to_refusal(const safety_state_t& message);

/// PILOT_STATE without its times.
pilot_state_t to_state_message(const pilot::Report& report);

}  // namespace roomwise
