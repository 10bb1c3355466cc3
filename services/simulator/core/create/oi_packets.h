#pragma once
#include <cstdint>
#include <vector>

#include "services/simulator/core/create/body_readings.h"

namespace roomwise::simulator {

enum class CreateModel { kCreate1, kCreate2 };

enum class OiMode : std::uint8_t { kOff = 0, kPassive = 1, kSafe = 2, kFull = 3 };

/// Sensor packets with a meaning of their own here.
inline constexpr std::uint8_t kDistancePacket = 19;
inline constexpr std::uint8_t kAnglePacket = 20;

/// What the sensor packets say at one instant: the body's readings and the interface's own state.
struct OiSnapshot {
  BodyReadings body;
  std::int16_t distance_mm = 0;  ///< since the last read
  std::int16_t angle_deg = 0;    ///< since the last read, counter-clockwise positive
  std::uint8_t mode = 0;         ///< as packet 35 sends it
  std::uint8_t song = 0;
  bool song_playing = false;
  std::uint8_t stream_packets = 0;
  std::int16_t requested_velocity_mmps = 0;
  std::int16_t requested_radius_mm = 0;
  LeftRight<std::int16_t> requested_mmps;
  bool moves_forward = false;
};

/// The single packets, in order, that packet or group `id` stands for; empty if the model has no
/// such packet.
struct PacketRange {
  std::uint8_t first = 1;
  std::uint8_t last = 0;
  bool empty() const { return last < first; }
};
PacketRange packets_of(std::uint8_t id, CreateModel model);

/// Appends the data of the single packet `id` (7 to 58): one byte, or two with the high one first.
///
/// Source: iRobot Create 2 Open Interface specification (2015), sensor packets; iRobot Create Open
/// Interface (2006) for the Create 1.
void append_packet(std::uint8_t id, CreateModel model, const OiSnapshot& snapshot,
                   std::vector<std::uint8_t>& out);

}  // namespace roomwise::simulator
