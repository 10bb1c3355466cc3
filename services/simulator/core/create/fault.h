#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/time.h"
#include "services/simulator/core/left_right.h"

namespace roomwise::simulator {

/// What can go wrong with a Create, its serial line and the camera on it.
enum class FaultKind : std::uint8_t {
  // on the line
  kByteLoss,        ///< a byte of a stream frame never arrives
  kByteFlip,        ///< a byte of a stream frame arrives changed
  kDuplicateFrame,  ///< a stream frame arrives twice
  kWrongLength,     ///< the N of a stream frame is one too large
  kSilence,         ///< nothing arrives
  kHangUp,          ///< the port goes away and comes back
  // on the camera's cable
  kCameraUnplug,  ///< the camera goes away and comes back
  // in the robot
  kReboot,            ///< the power is cut: banner in mid-stream, mode Off
  kModeDrop,          ///< to Passive, for no reason that can be seen
  kMode32,            ///< reports mode 32 and no longer changes mode
  kPowerButton,       ///< wakes a sleeping robot
  kRolloverForward,   ///< the counters stand just below 65536
  kRolloverBackward,  ///< the counters stand just above 0
  kBatteryLow,        ///< 5 % left
  kEncoderStuck,      ///< a counter stands while its wheel turns
  kNineteenInData,    ///< sensors read 19 and 0x1313, the frame header
  kCharger,           ///< the charger's plug is in, and powered
  kBump,              ///< a bumper is held
  kWheelDrop,         ///< a wheel hangs
  kCliff,             ///< the cliff sensors see no floor
};

/// One thing that goes wrong, and when.
struct Fault {
  FaultKind kind = FaultKind::kByteLoss;
  Duration at{};                       ///< since the start
  Duration lasting{};                  ///< of what lasts
  LeftRight<bool> sides{true, true};   ///< of what has sides
  int count = 1;                       ///< stream frames it happens to
  std::optional<std::size_t> at_byte;  ///< in the frame; its middle if not given

  bool is_active(Duration now) const { return now >= at && now < at + lasting; }
};

/// Reads "at_s=3,kind=byte_flip" with any of for_s, side (left, right, both), count and byte.
/// Throws std::runtime_error naming what is wrong with it.
Fault parse_fault(std::string_view text);

}  // namespace roomwise::simulator
