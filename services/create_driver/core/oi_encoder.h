#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/create/open_interface.h"
#include "services/create_driver/core/wheel_speeds.h"

namespace roomwise::create {

using Bytes = std::vector<std::uint8_t>;

/// What stops the wheels and leaves the robot in Passive, whatever was sent before: zeros, which
/// complete a command cut short (alone they mean nothing), Drive Direct 0 0, Start.
inline constexpr std::array<std::uint8_t, 22> kStopAndRest = {0, 0, 0, 0, 0, 0,   0, 0, 0, 0, 0,
                                                              0, 0, 0, 0, 0, 145, 0, 0, 0, 0, 128};

/// Appends a command without data: Start, Safe, Full, Reset, ...
void append_command(Opcode opcode, Bytes& bytes);

/// Appends Drive Direct (145): right wheel first, then left, in mm/s to the nearest, at most 500
/// either way. Not finite: 0.
void append_drive(const WheelSpeeds& speeds, Bytes& bytes);

/// Appends Stream (148): these packets every 15 ms from now on.
void append_stream_request(std::span<const std::uint8_t> ids, Bytes& bytes);

/// Appends Sensors (142): one packet, once, without frame.
void append_query(std::uint8_t id, Bytes& bytes);

}  // namespace roomwise::create
