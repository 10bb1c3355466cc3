#include "common/create/sensor_packets.h"

#include <numeric>

namespace roomwise::create {
namespace {

int as_sent(PacketForm form, int value) {
  if (form.size == 2) {
    const auto word = static_cast<std::uint16_t>(value);
    return form.is_signed ? static_cast<std::int16_t>(word) : word;
  }
  const auto byte = static_cast<std::uint8_t>(value);
  return form.is_signed ? static_cast<std::int8_t>(byte) : byte;
}

}  // namespace

void SensorPackets::set(Packet packet, int value) {
  values_[index(packet)] = as_sent(packet_form(static_cast<std::uint8_t>(packet)), value);
  known_[index(packet)] = true;
}

void SensorPackets::merge(const SensorPackets& newer) {
  for (std::size_t i = kFirstPacket; i <= kLastPacket; ++i) {
    if (newer.known_[i]) values_[i] = newer.values_[i];
  }
  known_ |= newer.known_;
}

bool read_packets(std::uint8_t id, std::span<const std::uint8_t> bytes, SensorPackets& packets) {
  if (bytes.empty() || bytes.size() != packet_size(id)) return false;
  const PacketRange range = packets_of(id);
  for (std::uint8_t member = range.first; member <= range.last; ++member) {
    const PacketForm form = packet_form(member);
    const int value = form.size == 2 ? bytes[0] << 8 | bytes[1] : bytes[0];
    packets.set(static_cast<Packet>(member), value);
    bytes = bytes.subspan(form.size);
  }
  return true;
}

void append_packets(std::uint8_t id, const SensorPackets& packets,
                    std::vector<std::uint8_t>& bytes) {
  const PacketRange range = packets_of(id);
  for (std::uint8_t member = range.first; member <= range.last; ++member) {
    const int value = packets[static_cast<Packet>(member)];
    if (packet_form(member).size == 2) bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes.push_back(static_cast<std::uint8_t>(value));
  }
}

void append_stream_frame(std::span<const std::uint8_t> ids, const SensorPackets& packets,
                         std::vector<std::uint8_t>& bytes) {
  const auto start = static_cast<std::ptrdiff_t>(bytes.size());
  bytes.push_back(kStreamHeader);
  bytes.push_back(0);
  for (const std::uint8_t id : ids) {
    bytes.push_back(id);
    append_packets(id, packets, bytes);
  }
  const auto frame = bytes.begin() + start;
  frame[1] = static_cast<std::uint8_t>(bytes.end() - frame - 2);
  bytes.push_back(static_cast<std::uint8_t>(-std::accumulate(frame, bytes.end(), 0)));
}

}  // namespace roomwise::create
