#pragma once
#include "services/simulator/core/create/body_readings.h"
#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/robot_motion.h"
#include "services/simulator/core/robot_params.h"

namespace roomwise::simulator {

/// Wheel travel one encoder tick stands for: 508.8 ticks a turn of a 72 mm wheel.
inline constexpr double kTravelPerTick_m = 3.14159265358979323846 * 0.072 / 508.8;

/// The 16-bit counter of a wheel that has turned this far since it was 0. Exact for 10^9 m.
std::uint16_t encoder_ticks(double turned_m);

/// What the sensors read of the body and of the plan around it. Battery, charger and buttons are
/// left as BodyReadings has them.
///   - bumpers: a touch within 90 degrees of straight ahead closes the switch of its side, within
///     10 degrees both;
///   - cliffs: floor or none under four points at the front rim;
///   - wall and light bumpers: beams from the rim, signal falling with the distance squared.
BodyReadings read_body(const RobotMotion& motion, const GroundPlan& plan,
                       const RobotParams& params);

}  // namespace roomwise::simulator
