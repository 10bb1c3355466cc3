#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace roomwise::create {

/// What the driver counts, for HEALTH.
enum class DriverEvent : std::uint8_t {
  kCommandUnsigned,
  kCommandForged,
  kCommandNotFinite,
  kCommandAbsurd,
  kCommandExpired,
  kCommandFromFuture,
  kCommandOutOfOrder,
  kCommandOtherSession,
  kCommandsSilent,      ///< no fresh command any more: wheels set to zero
  kModeDropped,         ///< the robot left its mode by itself
  kModeRefused,         ///< it did not enter the mode it was told to
  kModeByteOffset,      ///< it reports one more than it means
  kModeUnknown,         ///< 32, or another number no manual lists
  kRobotReset,          ///< Reset was sent, for want of another way out
  kRobotBooted,         ///< it printed its boot text
  kRobotSilent,         ///< the stream stopped, or did not start
  kHostStalled,         ///< this process was held up: the guardian may have stopped the robot
  kChecksumSwitched,    ///< the other reading of the checksum was taken up
  kFramesDamaged,       ///< wrong checksum
  kBytesSkipped,        ///< bytes of no frame
  kReadingLost,         ///< Create 1: distance and angle asked for and not received
  kOdometryGap,         ///< the pose begins anew: too long without a reading
  kOdometryJump,        ///< the pose begins anew: counters moved more than wheels can
  kOdometryOutOfOrder,  ///< a reading not used
  kCount,
};

/// The counter's name on HEALTH.
constexpr std::string_view name_of(DriverEvent event) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(DriverEvent::kCount)> kNames = {
      "command_unsigned", "command_forged",      "command_not_finite",   "command_absurd",
      "command_expired",  "command_from_future", "command_out_of_order", "command_other_session",
      "commands_silent",  "mode_dropped",        "mode_refused",         "mode_byte_offset",
      "mode_unknown",     "robot_reset",         "robot_booted",         "robot_silent",
      "host_stalled",     "checksum_switched",   "frames_damaged",       "bytes_skipped",
      "reading_lost",     "odometry_gap",        "odometry_jump",        "odometry_out_of_order"};
  return kNames[static_cast<std::size_t>(event)];
}

/// How often each has happened.
class DriverCounts {
 public:
  void add(DriverEvent event, std::int64_t times = 1) { counts_[index(event)] += times; }
  std::int64_t operator[](DriverEvent event) const { return counts_[index(event)]; }

 private:
  static std::size_t index(DriverEvent event) { return static_cast<std::size_t>(event); }
  std::array<std::int64_t, static_cast<std::size_t>(DriverEvent::kCount)> counts_{};
};

}  // namespace roomwise::create
