#pragma once
#include <cstdint>

#include "services/pilot_svc/core/steering.h"

namespace roomwise::pilot {

enum class Behaviour : std::uint8_t { kStop, kWander, kCircle, kGoTo };

/// What somebody wants the robot to do by itself.
struct Goal {
  Behaviour behaviour = Behaviour::kStop;
  double speed_mps = 0.0;   ///< at most; 0: PilotParams' own
  double duration_s = 0.0;  ///< done after that long; 0: no limit
  double x_m = 0.0;         ///< kGoTo: map frame
  double y_m = 0.0;
  double circle_distance_m = 0.5;  ///< kCircle: between the robot's rim and the object
  int circle_sense = 1;            ///< kCircle: 1 counter-clockwise seen from above, -1 clockwise
  double circle_rounds = 1.0;      ///< kCircle
};

enum class State : std::uint8_t { kIdle, kDriving, kRecovering, kWaiting, kDone, kFailed };

enum class Failure : std::uint8_t {
  kNone,
  kBadGoal,
  kNoSegments,
  kNoOdometry,
  kNoPose,
  kStuck,
  kNoObject,
  kObjectLost,
  kNoWay,
};

/// True if every number of the goal can be meant.
bool is_sound(const Goal& goal);

/// What a behaviour wants at one instant.
struct Step {
  Motion motion{};
  State state = State::kDriving;
  Failure failure = Failure::kNone;
  double bearing_rad = 0.0;  ///< it heads for
};

/// How far it has come.
struct Progress {
  double ratio = 0.0;                    ///< 0 to 1; 0 where a behaviour has no end
  double goal_distance_m = 0.0;          ///< kGoTo
  double turned_about_object_rad = 0.0;  ///< kCircle
  double object_distance_m = 0.0;        ///< kCircle: rim to object; 0: not known
};

}  // namespace roomwise::pilot
