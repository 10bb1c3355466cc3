#include "services/pilot_svc/core/steering.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace roomwise::pilot {
namespace {

RC_GTEST_PROP(Steering, StaysUnderItsLimitsAndTurnsToTheSideAskedFor, ()) {
  const PilotParams params;
  const double bearing_rad = *rc::gen::inRange(-3141, 3141) * 1e-3;
  const double way_m = *rc::gen::inRange(0, 3000) * 1e-3;
  const Motion motion = steer(bearing_rad, way_m, 0.25, params);
  RC_ASSERT(motion.speed_mps >= 0.0);
  RC_ASSERT(motion.speed_mps <= 0.25);
  RC_ASSERT(motion.speed_mps <= params.slow_down_hz * way_m);
  RC_ASSERT(std::abs(motion.turn_rate_radps) <= params.turn_rate_radps);
  RC_ASSERT(motion.turn_rate_radps * bearing_rad >= 0.0);
}

TEST(Steering, TurnsOnTheSpotWhenFarOffCourse) {
  EXPECT_EQ(steer(1.5, 3.0, 0.25, {}).speed_mps, 0.0);
  EXPECT_EQ(steer(0.0, 3.0, 0.25, {}).speed_mps, 0.25);
}

}  // namespace
}  // namespace roomwise::pilot
