#include "services/create_driver/core/create_driver.h"

#include <algorithm>
#include <chrono>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kStall = milliseconds(100);  // the guardian acts after 150
constexpr Duration kBlind = milliseconds(200);
constexpr Duration kDrivePeriod = milliseconds(20);
constexpr Duration kOneBoot = seconds(3);  // a robot prints its boot text within this
constexpr int kFrameOverhead = 3;          // header, length, checksum

/// Create 2: everything. Create 1: everything but group 2, whose distance and angle are asked for
/// more rarely (BodyReadings).
std::vector<std::uint8_t> stream_ids(Model model) {
  if (model == Model::kCreate1) return {1, 3, 4, 5};
  return {100};
}

Duration transfer_time(const CreateParams& params) {
  std::size_t bytes = kFrameOverhead;
  for (const std::uint8_t id : stream_ids(model_of(params))) bytes += 1 + packet_size(id);
  return Duration(static_cast<Duration::rep>(bytes) * 10 * 1'000'000 / baud_of(params));
}

OiMode target_of(const CreateParams& params) {
  return params.mode == "full" ? OiMode::kFull : OiMode::kSafe;
}

Rounding rounding_of(const CreateParams& params) {
  return params.angle_rounding == "carry" ? Rounding::kCarry : Rounding::kTruncate;
}

Wish wish_of(const std::optional<VelocityCommand>& command) {
  if (!command) return Wish::kStand;
  if (command->speed_mps > 0.0) return Wish::kForward;
  const bool stands = command->speed_mps == 0.0 && command->turn_rate_radps == 0.0;
  return stands ? Wish::kStand : Wish::kBackOrTurn;
}

}  // namespace

CreateDriver::CreateDriver(const CreateParams& params)
    : params_(params),
      model_(model_of(params)),
      decoder_(stream_ids(model_)),
      frame_times_(transfer_time(params)),
      mode_keeper_(model_, target_of(params), stream_ids(model_)),
      encoder_odometry_(params.wheels),
      body_odometry_(params.wheels, rounding_of(params)) {}

void CreateDriver::port_opened(const Instant& now) {
  decoder_.restart();
  body_readings_.restart();
  encoder_odometry_.rebase();
  body_odometry_.rebase();
  gate_.drop();
  commanded_ = {};
  last_step_ = now.steady;
  mode_keeper_.begin(now.steady);
}

void CreateDriver::command(const Instant& now, const VelocityCommand& command) {
  if (const auto refusal = gate_.offer(now, command)) counts_.add(*refusal);
}

std::span<const std::uint8_t> CreateDriver::step(const Instant& now,
                                                 std::span<const std::uint8_t> received) {
  to_send_.clear();
  reports_.clear();
  notice_stall(now);
  receive(now, received);
  mode_keeper_.step(now.steady, wish_of(gate_.in_force(now)), counts_, to_send_);
  drive(now);
  if (model_ == Model::kCreate1 && mode_keeper_.line_is_free(now.steady)) {
    body_readings_.ask_if_due(now.steady, to_send_);
  }
  return to_send_;
}

/// Held up, this process sent no heartbeats, and what it last decided is stale.
void CreateDriver::notice_stall(const Instant& now) {
  if (now.steady - last_step_ >= kStall) {
    counts_.add(DriverEvent::kHostStalled);
    gate_.drop();
    commanded_ = {};
    mode_keeper_.begin(now.steady);
  }
  last_step_ = now.steady;
}

void CreateDriver::receive(const Instant& now, std::span<const std::uint8_t> received) {
  frames_.clear();
  decoder_.push(received, [this](const StreamFrame& frame) { frames_.push_back(frame); });
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    use_frame(now, frames_[i], frames_.size() - 1 - i);
  }
  notice_boot(now);
  note_decoder();
}

void CreateDriver::notice_boot(const Instant& now) {
  const int lines = decoder_.boot_text().boot_lines();
  if (lines == boot_lines_) return;
  const bool is_new_boot = boot_lines_ == 0 || now.steady - last_boot_line_ > kOneBoot;
  if (is_new_boot) {
    ++robot_restarts_;
    counts_.add(DriverEvent::kRobotBooted);
  }
  boot_lines_ = lines;
  last_boot_line_ = now.steady;
  encoder_odometry_.rebase();
  body_odometry_.rebase();
  mode_keeper_.robot_boots(now.steady);
}

void CreateDriver::use_frame(const Instant& now, const StreamFrame& frame,
                             std::size_t frames_after) {
  FrameReport report;
  report.time = frame_times_.date(now.wall, frames_after);
  packets_.merge(frame.packets);
  report.odometry =
      model_ == Model::kCreate2 ? encoder_step(report.time) : body_step(now, report.time, frame);
  last_frame_ = now.steady;
  last_frame_time_ = report.time;
  mode_keeper_.see(now.steady, packets_);
  report.packets = packets_;
  report.mode = mode_keeper_.mode();
  report.state = state_;
  report.commanded = commanded_;
  report.mode_drops = mode_keeper_.mode_drops();
  report.robot_restarts = robot_restarts_;
  reports_.push_back(report);
}

std::optional<OdometryStep> CreateDriver::encoder_step(Time time) {
  const auto left = static_cast<std::uint16_t>(packets_[Packet::kEncoderLeft]);
  const auto right = static_cast<std::uint16_t>(packets_[Packet::kEncoderRight]);
  if (!counts_as_step(encoder_odometry_.update(time, left, right))) return std::nullopt;
  return encoder_odometry_.step();
}

std::optional<OdometryStep> CreateDriver::body_step(const Instant& now, Time time,
                                                    const StreamFrame& frame) {
  constexpr Duration kLongest = milliseconds(100);  // what was asked for longer ago says little
  const Duration interval = std::clamp(time - last_frame_time_, Duration(0), kLongest);
  body_odometry_.expect(interval, 1e-3 * packets_[Packet::kRequestedLeft_mmps],
                        1e-3 * packets_[Packet::kRequestedRight_mmps]);
  SensorPackets reading;
  const auto outcome = body_readings_.look(now.steady, frame, reading);
  if (outcome == BodyReadings::Outcome::kNothing) return std::nullopt;
  if (outcome == BodyReadings::Outcome::kLost) {
    counts_.add(DriverEvent::kReadingLost);
    body_odometry_.reading_lost();
    return std::nullopt;
  }
  packets_.merge(reading);
  counts_.add(DriverEvent::kBytesSkipped, -static_cast<std::int64_t>(frame.gap_size));
  const auto verdict =
      body_odometry_.update(time, reading[Packet::kDistance_mm], reading[Packet::kAngle_deg]);
  if (!counts_as_step(verdict)) return std::nullopt;
  return body_odometry_.step();
}

bool CreateDriver::counts_as_step(OdometryVerdict verdict) {
  if (verdict == OdometryVerdict::kGap) counts_.add(DriverEvent::kOdometryGap);
  if (verdict == OdometryVerdict::kJump) counts_.add(DriverEvent::kOdometryJump);
  if (verdict == OdometryVerdict::kOutOfOrder) counts_.add(DriverEvent::kOdometryOutOfOrder);
  return verdict == OdometryVerdict::kStep;
}

void CreateDriver::drive(const Instant& now) {
  const auto command = gate_.in_force(now);
  note_state(command.has_value());
  if (!mode_keeper_.may_drive()) {
    commanded_ = {};
    return;
  }
  const WheelSpeeds speeds = speeds_now(now, command);
  const bool is_due = speeds != commanded_ || now.steady - last_drive_ >= kDrivePeriod;
  if (!is_due) return;
  append_drive(speeds, to_send_);
  commanded_ = speeds;
  last_drive_ = now.steady;
}

WheelSpeeds CreateDriver::speeds_now(const Instant& now,
                                     const std::optional<VelocityCommand>& command) const {
  const bool is_blind = now.steady - last_frame_ >= kBlind;
  if (!command || is_blind) return {};
  return limited(
      wheel_speeds(command->speed_mps, command->turn_rate_radps, params_.wheels.wheel_base_m),
      params_.speed_max_mps);
}

void CreateDriver::note_state(bool has_command) {
  const DriverState before = state_;
  if (mode_keeper_.may_drive()) {
    state_ = has_command ? DriverState::kDriving : DriverState::kSilent;
  } else {
    state_ = mode_keeper_.is_held() ? DriverState::kHeld : DriverState::kStarting;
  }
  if (before == DriverState::kDriving && state_ == DriverState::kSilent) {
    counts_.add(DriverEvent::kCommandsSilent);
  }
}

void CreateDriver::note_decoder() {
  const DecoderCounts& now = decoder_.counts();
  counts_.add(DriverEvent::kFramesDamaged, now.checksum_failures - noted_.checksum_failures);
  counts_.add(DriverEvent::kChecksumSwitched, now.checksum_switches - noted_.checksum_switches);
  counts_.add(DriverEvent::kBytesSkipped, now.bytes_skipped - noted_.bytes_skipped);
  noted_ = now;
}

}  // namespace roomwise::create
