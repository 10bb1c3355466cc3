#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/create/open_interface.h"

namespace roomwise::create {

/// Sensor packets by the manual's numbers.
enum class Packet : std::uint8_t {
  kBumpsAndDrops = 7,
  kWall = 8,
  kCliffLeft = 9,
  kCliffFrontLeft = 10,
  kCliffFrontRight = 11,
  kCliffRight = 12,
  kVirtualWall = 13,
  kOvercurrents = 14,
  kDirt = 15,
  kUnused16 = 16,
  kInfraredOmni = 17,
  kButtons = 18,
  kDistance_mm = 19,
  kAngle_deg = 20,
  kChargingState = 21,
  kVoltage_mv = 22,
  kCurrent_ma = 23,
  kTemperature_c = 24,
  kCharge_mah = 25,
  kCapacity_mah = 26,
  kWallSignal = 27,
  kCliffLeftSignal = 28,
  kCliffFrontLeftSignal = 29,
  kCliffFrontRightSignal = 30,
  kCliffRightSignal = 31,
  kDigitalInputs = 32,  ///< Create 1
  kAnalogInput = 33,    ///< Create 1
  kChargingSources = 34,
  kOiMode = 35,
  kSongNumber = 36,
  kSongPlaying = 37,
  kStreamPackets = 38,
  kRequestedVelocity_mmps = 39,
  kRequestedRadius_mm = 40,
  kRequestedRight_mmps = 41,
  kRequestedLeft_mmps = 42,
  kEncoderLeft = 43,  ///< from here on Create 2 only
  kEncoderRight = 44,
  kLightBumper = 45,
  kLightLeft = 46,
  kLightFrontLeft = 47,
  kLightCenterLeft = 48,
  kLightCenterRight = 49,
  kLightFrontRight = 50,
  kLightRight = 51,
  kInfraredLeft = 52,
  kInfraredRight = 53,
  kLeftMotorCurrent_ma = 54,
  kRightMotorCurrent_ma = 55,
  kMainBrushCurrent_ma = 56,
  kSideBrushCurrent_ma = 57,
  kStasis = 58,
};

inline constexpr std::uint8_t kFirstPacket = 7;
inline constexpr std::uint8_t kLastPacket = 58;
inline constexpr std::uint8_t kLastPacketCreate1 = 42;

/// The packets a number asks for, first to last; first > last: the manual does not know it.
struct PacketRange {
  std::uint8_t first = 1;
  std::uint8_t last = 0;
  constexpr bool is_empty() const { return first > last; }
};

/// What a packet or group number stands for: itself, or the members of the group.
constexpr PacketRange packets_of(std::uint8_t id) {
  if (id >= kFirstPacket && id <= kLastPacket) return {id, id};
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
      return {};
  }
}

/// Whether `model` can answer a packet or group number.
constexpr bool model_has(Model model, std::uint8_t id) {
  const PacketRange range = packets_of(id);
  return !range.is_empty() && (model == Model::kCreate2 || range.last <= kLastPacketCreate1);
}

/// How one packet lies on the wire: high byte first, two's complement if it is signed.
struct PacketForm {
  std::uint8_t size = 0;  ///< bytes: 1 or 2; 0: no packet of that number
  bool is_signed = false;
};

constexpr PacketForm packet_form(std::uint8_t id) {
  constexpr PacketForm kU8{1, false};
  constexpr PacketForm kS8{1, true};
  constexpr PacketForm kU16{2, false};
  constexpr PacketForm kS16{2, true};
  if (id < kFirstPacket || id > kLastPacket) return {};
  if (id == 24) return kS8;
  if (id == 19 || id == 20 || id == 23) return kS16;
  if (id >= 39 && id <= 42) return kS16;
  if (id >= 54 && id <= 57) return kS16;
  if (id == 22 || id == 25 || id == 26 || id == 33) return kU16;
  if (id >= 27 && id <= 31) return kU16;
  if (id == 43 || id == 44 || (id >= 46 && id <= 51)) return kU16;
  return kU8;
}

/// Bytes that a packet or group number brings; 0: the manual does not know it.
constexpr std::size_t packet_size(std::uint8_t id) {
  const PacketRange range = packets_of(id);
  std::size_t size = 0;
  for (int member = range.first; member <= range.last; ++member) {
    size += packet_form(static_cast<std::uint8_t>(member)).size;
  }
  return size;
}

static_assert(packet_size(0) == 26 && packet_size(1) == 10 && packet_size(2) == 6);
static_assert(packet_size(3) == 10 && packet_size(4) == 14 && packet_size(5) == 12);
static_assert(packet_size(6) == 52 && packet_size(100) == 80 && packet_size(101) == 28);
static_assert(packet_size(106) == 12 && packet_size(107) == 9 && packet_size(99) == 0);

}  // namespace roomwise::create
