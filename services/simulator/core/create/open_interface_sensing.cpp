// What the robot sends: queries, the stream, and the state they report.
#include <algorithm>
#include <numbers>
#include <utility>

#include "services/simulator/core/create/open_interface.h"

namespace roomwise::simulator {
namespace {

constexpr std::uint8_t kFrameHeader = 19;
constexpr std::uint8_t kLockedMode = 32;
constexpr int kBitsPerByte = 10;

}  // namespace

void OpenInterface::sense(const BodyReadings& body) {
  body_ = body;
  odometer_.sample(body_.turned_m);
  trip_if_unsafe();
  if (!is_deaf() && !stream_.empty() && !stream_paused_) send_stream_frame();
}

std::vector<Transmission> OpenInterface::take_transmissions() {
  return std::exchange(transmissions_, {});
}

void OpenInterface::obey_sensing(const OiCommand& command) {
  const auto& arguments = command.arguments;
  switch (command.opcode) {
    case op::kSensors:
      return reply({arguments[0]});
    case op::kQueryList:
      return reply({arguments.begin() + 1, arguments.end()});
    case op::kStream:
      stream_.assign(arguments.begin() + 1, arguments.end());
      stream_paused_ = false;
      return;
    case op::kPauseResume:
      stream_paused_ = arguments[0] == 0;
      return;
    default: {
      std::vector<std::uint8_t> script = script_.stored();
      script.insert(script.begin(), static_cast<std::uint8_t>(script.size()));
      transmissions_.push_back({std::move(script), false});
    }
  }
}

void OpenInterface::reply(const std::vector<std::uint8_t>& ids) {
  Transmission answer;
  for (const std::uint8_t id : ids) append_packets(id, answer.bytes);
  if (!answer.bytes.empty()) transmissions_.push_back(std::move(answer));
}

void OpenInterface::send_stream_frame() {
  Transmission frame{{kFrameHeader, 0}, true};
  for (const std::uint8_t id : stream_) {
    if (packets_of(id, model_).empty()) continue;
    frame.bytes.push_back(id);
    append_packets(id, frame.bytes);
  }
  if (frame.bytes.size() == 2) return;
  frame.bytes[1] = static_cast<std::uint8_t>(frame.bytes.size() - 2);
  unsigned sum = params_.checksum == "with_header" ? 0U : 0U - kFrameHeader;
  for (const std::uint8_t byte : frame.bytes) sum += byte;
  frame.bytes.push_back(static_cast<std::uint8_t>(0U - sum));
  // What has not left when the next frame is due never will.
  frame.bytes.resize(std::min(frame.bytes.size(), bytes_per_slot()));
  transmissions_.push_back(std::move(frame));
}

std::size_t OpenInterface::bytes_per_slot() const {
  return static_cast<std::size_t>(baud_) * static_cast<std::size_t>(kSensorPeriod.count()) /
         (kBitsPerByte * 1'000'000);
}

void OpenInterface::append_packets(std::uint8_t id, std::vector<std::uint8_t>& out) {
  const PacketRange range = packets_of(id, model_);
  OiSnapshot state = snapshot();
  for (int single = range.first; single <= range.last; ++single) {
    if (single == kDistancePacket) state.distance_mm = odometer_.take_distance_mm();
    if (single == kAnglePacket) state.angle_deg = odometer_.take_angle_deg();
    append_packet(static_cast<std::uint8_t>(single), model_, state, out);
  }
}

OiSnapshot OpenInterface::snapshot() const {
  return {.body = body_,
          .mode = mode_byte(),
          .song = song_.number(),
          .song_playing = song_.is_playing(now_),
          .stream_packets = static_cast<std::uint8_t>(stream_.size()),
          .requested_velocity_mmps = drive_.velocity_mmps(),
          .requested_radius_mm = drive_.radius_mm(),
          .requested_mmps = drive_.direct_mmps(),
          .moves_forward = moves_forward()};
}

std::uint8_t OpenInterface::mode_byte() const {
  if (locked_) return kLockedMode;
  const auto mode = static_cast<std::uint8_t>(mode_);
  return params_.mode_byte == "plus_one" ? static_cast<std::uint8_t>(mode + 1U) : mode;
}

/// Progress as a caster's turning would show it: both wheels ahead, and neither held.
bool OpenInterface::moves_forward() const {
  const LeftRight<double> wheels = wheel_command_mps();
  return wheels.left > 0.0 && wheels.right > 0.0 && !body_.overcurrent.left &&
         !body_.overcurrent.right;
}

WaitInputs OpenInterface::wait_inputs() const {
  const LeftRight<double>& turned_m = body_.turned_m;
  const double turn_rad = (turned_m.right - turned_m.left) / wheel_base_m_;
  return {.now = now_,
          .distance_mm = 1000.0 * (turned_m.left + turned_m.right) / 2.0,
          .angle_deg = turn_rad * 180.0 / std::numbers::pi,
          .mode = mode_};
}

}  // namespace roomwise::simulator
