#pragma once
#include "common/create/odometry_step.h"
#include "common/create/sensor_packets.h"
#include "roomwise/create_state_t.hpp"
#include "roomwise/odometry_t.hpp"

namespace roomwise::create {

/// What a Create of `model` said at `time`, in SI units. The members about the driver (its state,
/// the speeds it commanded, mode drops, restarts) are left 0 for the caller; `mode` is packet 35
/// as the caller understands it.
create_state_t to_message(Time time, Model model, const SensorPackets& packets, OiMode mode);

odometry_t to_message(const OdometryStep& step);

}  // namespace roomwise::create
