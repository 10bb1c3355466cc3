#include "services/create_driver/core/oi_encoder.h"

#include <algorithm>
#include <cmath>

namespace roomwise::create {
namespace {

void append_word(int value, Bytes& bytes) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

int whole_mmps(double speed_mps) {
  if (!std::isfinite(speed_mps)) return 0;
  const double most = kWheelSpeedMax_mmps;
  return static_cast<int>(std::lround(std::clamp(1000.0 * speed_mps, -most, most)));
}

}  // namespace

void append_command(Opcode opcode, Bytes& bytes) {
  bytes.push_back(static_cast<std::uint8_t>(opcode));
}

void append_drive(const WheelSpeeds& speeds, Bytes& bytes) {
  append_command(Opcode::kDriveDirect, bytes);
  append_word(whole_mmps(speeds.right_mps), bytes);
  append_word(whole_mmps(speeds.left_mps), bytes);
}

void append_stream_request(std::span<const std::uint8_t> ids, Bytes& bytes) {
  append_command(Opcode::kStream, bytes);
  bytes.push_back(static_cast<std::uint8_t>(ids.size()));
  bytes.insert(bytes.end(), ids.begin(), ids.end());
}

void append_query(std::uint8_t id, Bytes& bytes) {
  append_command(Opcode::kSensors, bytes);
  bytes.push_back(id);
}

}  // namespace roomwise::create
