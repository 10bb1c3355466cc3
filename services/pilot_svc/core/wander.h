#pragma once
#include "services/pilot_svc/core/direction_choice.h"
#include "services/pilot_svc/core/goal.h"

namespace roomwise::pilot {

/// Goes where most floor can be reached that was not visited lately. Where no direction is open it
/// turns on the spot, one way round, until one is.
class Wander {
 public:
  Wander(const Goal& goal, const PilotParams& params);

  Step step(const Surroundings& around);

 private:
  Step drive(const Surroundings& around, const Direction& direction);
  Step look_about(const Surroundings& around);

  PilotParams params_;
  double speed_mps_;
  DirectionChoice choice_;
  double sense_ = 0.0;  // of turning on the spot; 0: none yet
};

/// The goal's speed, or the parameters' if it names none or more.
double speed_of(const Goal& goal, const PilotParams& params);

}  // namespace roomwise::pilot
