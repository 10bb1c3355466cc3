#pragma once
#include "services/pilot_svc/core/pilot_params.h"

namespace roomwise::pilot {

/// What is asked of safety_svc.
struct Motion {
  double speed_mps = 0.0;        ///< along robot x
  double turn_rate_radps = 0.0;  ///< counter-clockwise positive
};

/// Turns toward `bearing_rad` (robot frame) and drives the more the better it points there, no
/// faster than `speed_mps` and slower before the end of the free way ahead:
///   turn rate = gain * bearing,  speed = min(speed, slow_down * way) * cos(bearing),
/// on the spot while the bearing is larger than `turn_on_spot_rad` or the speed would be a crawl.
Motion steer(double bearing_rad, double way_ahead_m, double speed_mps, const PilotParams& params);

}  // namespace roomwise::pilot
