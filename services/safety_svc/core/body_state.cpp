#include "services/safety_svc/core/body_state.h"

namespace roomwise::safety {

ReasonSet vetoes_of(const BodyState& body) {
  ReasonSet reasons;
  if (!body.is_in_driving_mode) reasons.add(Reason::kMode);
  if (body.wheel_drop) reasons.add(Reason::kWheelDrop);
  if (body.overcurrent) reasons.add(Reason::kOvercurrent);
  if (body.is_charging) reasons.add(Reason::kCharging);
  return reasons;
}

ReasonSet ahead_vetoes_of(const BodyState& body) {
  ReasonSet reasons;
  if (body.bump) reasons.add(Reason::kBump);
  if (body.cliff) reasons.add(Reason::kCliff);
  if (body.virtual_wall) reasons.add(Reason::kWall);
  return reasons;
}

}  // namespace roomwise::safety
