#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

#include "common/create/packet_table.h"

namespace roomwise::create {

/// Sensor values by packet, in the robot's own units; 0 for those it has not sent.
class SensorPackets {
 public:
  int operator[](Packet packet) const { return values_[index(packet)]; }
  bool has(Packet packet) const { return known_[index(packet)]; }

  /// Stores what the wire can carry of `value`: its low bits, read as the packet's form says.
  void set(Packet packet, int value);

  /// Takes over every packet `newer` has.
  void merge(const SensorPackets& newer);

 private:
  static std::size_t index(Packet packet) { return static_cast<std::size_t>(packet); }

  std::array<std::int32_t, kLastPacket + 1> values_{};
  std::bitset<kLastPacket + 1> known_;
};

/// Reads the data of packet or group `id`. False, and nothing read, unless `bytes` is as long as
/// it.
[[nodiscard]] bool read_packets(std::uint8_t id, std::span<const std::uint8_t> bytes,
                                SensorPackets& packets);

/// Appends the data of packet or group `id`: what read_packets reads.
void append_packets(std::uint8_t id, const SensorPackets& packets,
                    std::vector<std::uint8_t>& bytes);

/// Appends a whole stream frame, `19 N (id data)... checksum`, whose bytes sum to 0 modulo 256.
void append_stream_frame(std::span<const std::uint8_t> ids, const SensorPackets& packets,
                         std::vector<std::uint8_t>& bytes);

}  // namespace roomwise::create
