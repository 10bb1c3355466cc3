#include "services/simulator/core/create/oi_packets.h"

#include <initializer_list>

namespace roomwise::simulator {
namespace {

constexpr std::uint8_t kFirst = 7;
constexpr std::uint8_t kLastCreate1 = 42;
constexpr std::uint8_t kLastCreate2 = 58;
/// A light bumper sees something from this signal on.
constexpr std::uint16_t kLightBumper = 200;

/// Bit 0 first.
int bits(std::initializer_list<bool> values) {
  int sum = 0;
  int weight = 1;
  for (const bool value : values) {
    sum += value ? weight : 0;
    weight *= 2;
  }
  return sum;
}

bool is_word(std::uint8_t id) {
  constexpr PacketRange kWords[] = {{19, 20}, {22, 23}, {25, 31}, {33, 33},
                                    {39, 44}, {46, 51}, {54, 57}};
  for (const PacketRange& words : kWords) {
    if (id >= words.first && id <= words.last) return true;
  }
  return false;
}

int contact_packet(std::uint8_t id, CreateModel model, const BodyReadings& body) {
  switch (id) {
    case 7:
      return bits({body.bump.right, body.bump.left, body.wheel_drop.right, body.wheel_drop.left,
                   model == CreateModel::kCreate1 && body.caster_drop});
    case 8:
      return body.wall ? 1 : 0;
    case 13:
      return body.virtual_wall ? 1 : 0;
    case 14:
      return bits({false, false, false, body.overcurrent.right, body.overcurrent.left});
    case 17:
      return model == CreateModel::kCreate1 ? 255 : 0;  // no infrared character in sight
    case 18:
      return body.buttons;
    default:
      return 0;  // dirt, and what is unused
  }
}

int power_packet(std::uint8_t id, const BodyReadings& body) {
  switch (id) {
    case 21:
      return body.charging_state;
    case 22:
      return body.voltage_mv;
    case 23:
      return body.current_ma;
    case 24:
      return body.temperature_c;
    case 25:
      return body.charge_mah;
    case 26:
      return body.capacity_mah;
    case 27:
      return body.wall_signal;
    case 34:
      return bits({body.internal_charger, body.home_base});
    default:
      return 0;  // 32 and 33: the Create 1's cargo bay, with nothing plugged in
  }
}

int state_packet(std::uint8_t id, const OiSnapshot& snapshot) {
  switch (id) {
    case 35:
      return snapshot.mode;
    case 36:
      return snapshot.song;
    case 37:
      return snapshot.song_playing ? 1 : 0;
    case 38:
      return snapshot.stream_packets;
    case 39:
      return snapshot.requested_velocity_mmps;
    case 40:
      return snapshot.requested_radius_mm;
    case 41:
      return snapshot.requested_mmps.right;
    default:
      return snapshot.requested_mmps.left;
  }
}

int light_bits(const BodyReadings& body) {
  const auto& s = body.light_signal;
  return bits({s[0] >= kLightBumper, s[1] >= kLightBumper, s[2] >= kLightBumper,
               s[3] >= kLightBumper, s[4] >= kLightBumper, s[5] >= kLightBumper});
}

int create2_packet(std::uint8_t id, const OiSnapshot& snapshot) {
  const BodyReadings& body = snapshot.body;
  if (id >= 46 && id <= 51) return body.light_signal[id - 46U];
  switch (id) {
    case 43:
      return body.encoder_ticks.left;
    case 44:
      return body.encoder_ticks.right;
    case 45:
      return light_bits(body);
    case 54:
      return body.wheel_current_ma.left;
    case 55:
      return body.wheel_current_ma.right;
    case 58:
      return snapshot.moves_forward ? 1 : 0;
    default:
      return 0;  // 52, 53: no infrared; 56, 57: no brushes
  }
}

int packet_value(std::uint8_t id, CreateModel model, const OiSnapshot& snapshot) {
  if (id >= 9 && id <= 12) return snapshot.body.cliff[id - 9U] ? 1 : 0;
  if (id >= 28 && id <= 31) return snapshot.body.cliff_signal[id - 28U];
  if (id <= 18) return contact_packet(id, model, snapshot.body);
  if (id == kDistancePacket) return snapshot.distance_mm;
  if (id == kAnglePacket) return snapshot.angle_deg;
  if (id <= 34) return power_packet(id, snapshot.body);
  if (id <= 42) return state_packet(id, snapshot);
  return create2_packet(id, snapshot);
}

PacketRange group_of(std::uint8_t id) {
  switch (id) {
    case 0:
      return {7, 26};
    case 1:
      return {7, 16};
    case 2:
      return {17, 20};
    case 3:
      return {21, 26};
    case 4:
      return {27, 34};
    case 5:
      return {35, 42};
    case 6:
      return {7, 42};
    case 100:
      return {7, 58};
    case 101:
      return {43, 58};
    case 106:
      return {46, 51};
    case 107:
      return {54, 58};
    default:
      return {id, id};
  }
}

}  // namespace

PacketRange packets_of(std::uint8_t id, CreateModel model) {
  const std::uint8_t last = model == CreateModel::kCreate1 ? kLastCreate1 : kLastCreate2;
  const PacketRange range = group_of(id);
  return range.first >= kFirst && range.last <= last ? range : PacketRange{};
}

void append_packet(std::uint8_t id, CreateModel model, const OiSnapshot& snapshot,
                   std::vector<std::uint8_t>& out) {
  const auto value = static_cast<unsigned>(packet_value(id, model, snapshot));
  if (is_word(id)) out.push_back(static_cast<std::uint8_t>(value >> 8U & 0xFFU));
  out.push_back(static_cast<std::uint8_t>(value & 0xFFU));
}

}  // namespace roomwise::simulator
