#pragma once

namespace roomwise::create {

// The file descriptors create_driver hands to create_guardian.
inline constexpr int kGuardianDriverFd = 3;  ///< beats in, answers out
inline constexpr int kGuardianPortFd = 4;    ///< the robot's serial port

/// Without a beat for this long the driver counts as dead.
inline constexpr int kGuardianSilence_ms = 150;

}  // namespace roomwise::create
