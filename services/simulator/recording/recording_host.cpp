#include "services/simulator/recording/recording_host.h"

#include <array>
#include <cmath>

#include "common/create/create_messages.h"

namespace roomwise::simulator {
namespace {

using create::Opcode;
using create::Packet;

constexpr std::array<std::uint8_t, 1> kEverything = {100};
constexpr std::int64_t kBitsPerByte = 10;
constexpr std::int64_t kBaud = 115'200;
/// Header, length, group number, its data, checksum.
constexpr std::int64_t kFrameBytes = 4 + create::packet_size(100);
constexpr Duration kTransfer{kFrameBytes * kBitsPerByte * 1'000'000 / kBaud};

std::uint8_t byte(Opcode opcode) { return static_cast<std::uint8_t>(opcode); }

void append_speed(double speed_mps, std::vector<std::uint8_t>& bytes) {
  const auto speed_mmps = static_cast<std::int16_t>(std::lround(1000.0 * speed_mps));
  bytes.push_back(static_cast<std::uint8_t>(speed_mmps >> 8));
  bytes.push_back(static_cast<std::uint8_t>(speed_mmps));
}

create::OiMode mode_of(int mode_byte) {
  return mode_byte >= 0 && mode_byte <= 3 ? static_cast<create::OiMode>(mode_byte)
                                          : create::OiMode::kUnknown;
}

}  // namespace

RecordingHost::RecordingHost() : decoder_(kEverything), odometry_(create::WheelGeometry{}) {}

void RecordingHost::talk(int turn, double left_mps, double right_mps,
                         std::vector<std::uint8_t>& to_robot) {
  if (turn == 0) to_robot.push_back(byte(Opcode::kStart));
  if (turn == 5) to_robot.push_back(byte(Opcode::kSafe));
  if (turn == 10) {
    to_robot.insert(to_robot.end(), {byte(Opcode::kStream), kEverything.size(), kEverything[0]});
  }
  if (turn >= kFirstDrivingTurn) drive(left_mps, right_mps, to_robot);
}

void RecordingHost::drive(double left_mps, double right_mps, std::vector<std::uint8_t>& to_robot) {
  left_mps_ = left_mps;
  right_mps_ = right_mps;
  to_robot.push_back(byte(Opcode::kDriveDirect));
  append_speed(right_mps, to_robot);
  append_speed(left_mps, to_robot);
}

void RecordingHost::receive(Time time, const std::vector<std::uint8_t>& bytes) {
  states_.clear();
  steps_.clear();
  decoder_.push(bytes,
                [&](const create::StreamFrame& frame) { use_frame(time - kTransfer, frame); });
}

void RecordingHost::use_frame(Time time, const create::StreamFrame& frame) {
  packets_.merge(frame.packets);
  create_state_t state = create::to_message(time, create::Model::kCreate2, packets_,
                                            mode_of(packets_[Packet::kOiMode]));
  state.seq = ++state_seq_;
  state.driver_state = create_state_t::DRIVER_DRIVING;
  state.commanded_left_mps = left_mps_;
  state.commanded_right_mps = right_mps_;
  states_.push_back(state);
  const auto left = static_cast<std::uint16_t>(packets_[Packet::kEncoderLeft]);
  const auto right = static_cast<std::uint16_t>(packets_[Packet::kEncoderRight]);
  if (odometry_.update(time, left, right) != create::OdometryVerdict::kStep) return;
  odometry_t step = create::to_message(odometry_.step());
  step.seq = ++step_seq_;
  steps_.push_back(step);
}

}  // namespace roomwise::simulator
