#pragma once
#include <cstdint>
#include <vector>

#include "services/simulator/core/create/oi_packets.h"

namespace roomwise::simulator {

/// Opcodes of the Open Interface.
namespace op {
inline constexpr std::uint8_t kReset = 7;  ///< Create 2
inline constexpr std::uint8_t kStart = 128;
inline constexpr std::uint8_t kBaud = 129;
inline constexpr std::uint8_t kControl = 130;
inline constexpr std::uint8_t kSafe = 131;
inline constexpr std::uint8_t kFull = 132;
inline constexpr std::uint8_t kPower = 133;
inline constexpr std::uint8_t kSpot = 134;   ///< Create 1: spot cover
inline constexpr std::uint8_t kClean = 135;  ///< Create 1: cover
inline constexpr std::uint8_t kMax = 136;    ///< Create 1: demo, with a byte
inline constexpr std::uint8_t kDrive = 137;
inline constexpr std::uint8_t kMotors = 138;
inline constexpr std::uint8_t kLeds = 139;
inline constexpr std::uint8_t kSong = 140;
inline constexpr std::uint8_t kPlay = 141;
inline constexpr std::uint8_t kSensors = 142;
inline constexpr std::uint8_t kSeekDock = 143;
inline constexpr std::uint8_t kPwmMotors = 144;
inline constexpr std::uint8_t kDriveDirect = 145;
inline constexpr std::uint8_t kDrivePwm = 146;        ///< Create 2
inline constexpr std::uint8_t kDigitalOutputs = 147;  ///< Create 1
inline constexpr std::uint8_t kStream = 148;
inline constexpr std::uint8_t kQueryList = 149;
inline constexpr std::uint8_t kPauseResume = 150;
inline constexpr std::uint8_t kSendIr = 151;  ///< Create 1, as all up to 158
inline constexpr std::uint8_t kScript = 152;
inline constexpr std::uint8_t kPlayScript = 153;
inline constexpr std::uint8_t kShowScript = 154;
inline constexpr std::uint8_t kWaitTime = 155;
inline constexpr std::uint8_t kWaitDistance = 156;
inline constexpr std::uint8_t kWaitAngle = 157;
inline constexpr std::uint8_t kWaitEvent = 158;
inline constexpr std::uint8_t kSchedulingLeds = 162;  ///< Create 2, as all below
inline constexpr std::uint8_t kDigitLedsRaw = 163;
inline constexpr std::uint8_t kDigitLedsAscii = 164;
inline constexpr std::uint8_t kButtons = 165;
inline constexpr std::uint8_t kSchedule = 167;
inline constexpr std::uint8_t kSetClock = 168;
inline constexpr std::uint8_t kStop = 173;
}  // namespace op

/// An opcode with the bytes that belong to it.
struct OiCommand {
  std::uint8_t opcode = 0;
  std::vector<std::uint8_t> arguments;

  /// Big-endian, two's complement, from the arguments at `offset` and the next.
  std::int16_t word(std::size_t offset) const {
    return static_cast<std::int16_t>(arguments[offset] << 8 | arguments[offset + 1]);
  }
};

/// Cuts the bytes a host sends into commands. A byte that is no opcode of the model is a command
/// without arguments.
class CommandReader {
 public:
  explicit CommandReader(CreateModel model) : model_(model) {}

  /// True when `byte` completes a command.
  [[nodiscard]] bool push(std::uint8_t byte);

  /// The command push() has completed; valid until the next push().
  const OiCommand& command() const { return command_; }

  /// Forgets a command half received.
  void clear() { complete_ = true; }

 private:
  std::size_t length_so_far() const;

  CreateModel model_;
  OiCommand command_;
  bool complete_ = true;
};

/// True if the model knows the opcode.
bool has_opcode(CreateModel model, std::uint8_t opcode);

/// True if the model acts on the opcode in that mode.
bool accepts(CreateModel model, OiMode mode, std::uint8_t opcode);

}  // namespace roomwise::simulator
