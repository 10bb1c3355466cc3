#pragma once
#include "services/safety_svc/core/swept_corridor.h"
#include "services/safety_svc/core/world.h"

namespace roomwise::safety {

/// What was allowed last, and when.
struct Granted {
  Request motion;
  Duration when{};
};

/// How the robot may move now, and why not more.
struct Decision {
  Request granted;                  ///< no more than asked, of the same sign, or zero
  Reason first = Reason::kAsAsked;  ///< what decides
  ReasonSet reasons;                ///< all that hold; empty: as asked
  double speed_limit_mps = 0.0;     ///< along the way asked for
  CorridorView corridor;            ///< the same way; nothing when nobody asks for a way ahead
  double reverse_way_m = 0.0;       ///< along the way asked for, or straight
};

/// The one decision: nothing that is not known to be harmless is allowed.
///
/// Zero for any of: nobody asks, an emergency stop, a clock or stamp that cannot be true, an input
/// that is missing or older than its limit, a mode that does not drive, a hanging wheel,
/// overcurrent, a charger. With a bumper, cliff or virtual wall only back; with the camera out of
/// place back or turning, which bring the floor into view again.
/// Otherwise what is asked, brought
///   - under the robot's limits and the acceleration's, speed and turn rate by one factor so that
///     the curvature stays; a turn rate that grows too fast is held back alone;
///   - ahead: under the speed that stops before what the arc sweeps (sweep, stopping.h), and to a
///     creep before what is only overlooked;
///   - back: to a creep, no farther than the robot came from.
/// Turning on the spot sweeps nothing: the robot is round.
Decision decide(const Instant& now, const World& world, const Granted& before,
                const SafetyParams& params);

}  // namespace roomwise::safety
