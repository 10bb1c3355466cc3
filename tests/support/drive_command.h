#pragma once
#include <cstdint>

#include "common/auth/command_signature.h"

namespace roomwise {

/// VEL_CMD number `sequence` of a session, as safety_svc sends it at `utime`: good for 0.2 s,
/// signed with `key`.
inline velocity_command_t drive_command(const SecretKey& key, std::int64_t utime,
                                        std::int64_t session, std::int64_t sequence,
                                        double speed_mps, double turn_rate_radps) {
  velocity_command_t command{};
  command.utime = utime;
  command.allowed_speed_mps = speed_mps;
  command.allowed_turn_rate_radps = turn_rate_radps;
  command.expiry_utime = utime + 200'000;
  command.session = session;
  command.sequence = sequence;
  sign(key, command);
  return command;
}

}  // namespace roomwise
