#pragma once
#include "services/safety_svc/core/reason.h"

namespace roomwise::safety {

/// What the robot's own sensors say.
struct BodyState {
  bool is_in_driving_mode = false;  ///< Safe or Full, and the driver neither starts nor is held
  bool bump = false;
  bool cliff = false;
  bool wheel_drop = false;
  bool virtual_wall = false;
  bool near_wall = false;  ///< wall sensor, or a light bumper that looks ahead
  bool overcurrent = false;
  bool is_charging = false;  ///< plugged in or on its dock
};

/// What keeps the wheels still whatever is asked.
ReasonSet vetoes_of(const BodyState& body);

/// What keeps the robot from everything but backing off.
ReasonSet ahead_vetoes_of(const BodyState& body);

}  // namespace roomwise::safety
