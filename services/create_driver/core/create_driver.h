#pragma once
#include <optional>
#include <span>
#include <vector>

#include "common/create/body_odometry.h"
#include "common/create/encoder_odometry.h"
#include "common/create/oi_decoder.h"
#include "services/create_driver/core/body_readings.h"
#include "services/create_driver/core/command_gate.h"
#include "services/create_driver/core/create_params.h"
#include "services/create_driver/core/frame_times.h"
#include "services/create_driver/core/mode_keeper.h"

namespace roomwise::create {

enum class DriverState : std::uint8_t { kStarting = 0, kDriving = 1, kSilent = 2, kHeld = 3 };

/// What became known with one stream frame.
struct FrameReport {
  Time time{};            ///< when the robot read its sensors
  SensorPackets packets;  ///< the newest of everything
  OiMode mode = OiMode::kUnknown;
  DriverState state = DriverState::kStarting;
  WheelSpeeds commanded;  ///< what was last sent to the wheels
  int mode_drops = 0;
  int robot_restarts = 0;
  std::optional<OdometryStep> odometry;
};

/// create_driver without its port and its bus: what to send, from what was received, the commands
/// and the time. Safe against silence on all sides: the wheels are told zero when
///   - no acceptable command came within 200 ms (kCommandLife),
///   - no stream frame came within 200 ms: it would drive blind,
///   - it was itself held up for 100 ms or more: then the guardian may have stopped the robot, and
///   it
///     begins again from Start, with no command in force.
class CreateDriver {
 public:
  explicit CreateDriver(const CreateParams& params);

  /// A port was opened: whatever is on it must be started. The counters start anew.
  void port_opened(const Instant& now);

  /// Takes a command, or counts why not.
  void command(const Instant& now, const VelocityCommand& command);

  /// One turn, to be taken every few milliseconds while the port is open: `received` since the
  /// last; returns what is to be sent, valid until the next call.
  std::span<const std::uint8_t> step(const Instant& now, std::span<const std::uint8_t> received);

  /// One report for each frame of the last step, in order.
  const std::vector<FrameReport>& reports() const { return reports_; }

  /// True while the robot's wake line is to be pulled low.
  bool pulls_wake_line(Duration now) const { return mode_keeper_.pulls_wake_line(now); }

  const DriverCounts& counts() const { return counts_; }
  const std::optional<Firmware>& firmware() const { return decoder_.boot_text().firmware(); }

 private:
  void notice_stall(const Instant& now);
  void receive(const Instant& now, std::span<const std::uint8_t> received);
  void notice_boot(const Instant& now);
  void use_frame(const Instant& now, const StreamFrame& frame, std::size_t frames_after);
  std::optional<OdometryStep> encoder_step(Time time);
  std::optional<OdometryStep> body_step(const Instant& now, Time time, const StreamFrame& frame);
  bool counts_as_step(OdometryVerdict verdict);
  void drive(const Instant& now);
  WheelSpeeds speeds_now(const Instant& now, const std::optional<VelocityCommand>& command) const;
  void note_state(bool has_command);
  void note_decoder();

  CreateParams params_;
  Model model_;
  OiDecoder decoder_;
  FrameTimes frame_times_;
  ModeKeeper mode_keeper_;
  CommandGate gate_;
  EncoderOdometry encoder_odometry_;
  BodyOdometry body_odometry_;
  BodyReadings body_readings_;

  SensorPackets packets_;
  std::vector<StreamFrame> frames_;  // of the step under way
  std::vector<FrameReport> reports_;
  Bytes to_send_;
  DriverState state_ = DriverState::kStarting;
  WheelSpeeds commanded_;
  Duration last_step_{};
  Duration last_drive_{};
  Duration last_frame_{};
  Time last_frame_time_{};
  int boot_lines_ = 0;
  Duration last_boot_line_{};
  int robot_restarts_ = 0;
  DecoderCounts noted_;
  DriverCounts counts_;
};

}  // namespace roomwise::create
