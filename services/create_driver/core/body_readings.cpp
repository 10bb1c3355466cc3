#include "services/create_driver/core/body_readings.h"

#include <chrono>

namespace roomwise::create {
namespace {

constexpr std::uint8_t kBodyGroup = 2;
constexpr Duration kPeriod = std::chrono::milliseconds(150);
constexpr Duration kPatience = std::chrono::milliseconds(100);

}  // namespace

void BodyReadings::ask_if_due(Duration now, Bytes& bytes) {
  if (is_waiting_ || now - asked_ < kPeriod) return;
  append_query(kBodyGroup, bytes);
  asked_ = now;
  is_waiting_ = true;
}

BodyReadings::Outcome BodyReadings::look(Duration now, const StreamFrame& frame,
                                         SensorPackets& packets) {
  if (!is_waiting_) return Outcome::kNothing;
  constexpr std::size_t kSize = packet_size(kBodyGroup);
  const auto answer = std::span(frame.gap_bytes).first(kSize);
  if (frame.gap_size == kSize && read_packets(kBodyGroup, answer, packets)) {
    is_waiting_ = false;
    return Outcome::kReading;
  }
  if (now - asked_ < kPatience) return Outcome::kNothing;
  is_waiting_ = false;
  return Outcome::kLost;
}

}  // namespace roomwise::create
