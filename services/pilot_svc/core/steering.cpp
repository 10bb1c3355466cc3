#include "services/pilot_svc/core/steering.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {
namespace {

/// Slower than this it turns on the spot: along an arc safety_svc would hold back the turn as well.
constexpr double kSlowest_mps = 0.03;

}  // namespace

Motion steer(double bearing_rad, double way_ahead_m, double speed_mps, const PilotParams& params) {
  const double turn_rate_radps = std::clamp(params.turn_gain_hz * bearing_rad,
                                            -params.turn_rate_radps, params.turn_rate_radps);
  if (std::abs(bearing_rad) > params.turn_on_spot_rad) return {0.0, turn_rate_radps};
  const double limit_mps = std::max(params.slow_down_hz * way_ahead_m, 0.0);
  const double drive_mps = std::min(speed_mps, limit_mps) * std::cos(bearing_rad);
  return {drive_mps < kSlowest_mps ? 0.0 : drive_mps, turn_rate_radps};
}

}  // namespace roomwise::pilot
