#include "services/simulator/core/create/serial_line.h"

#include <algorithm>
#include <cmath>

namespace roomwise::simulator {
namespace {

constexpr int kBitTimesPerByte = 10;

/// Level of the line `bits` bit times after the start of `byte`: start bit low, data with the
/// lowest first, stop bit and rest high.
bool level_at(std::uint8_t byte, double bits) {
  const int bit = static_cast<int>(std::floor(bits));
  if (bit < 0 || bit >= kBitTimesPerByte - 1) return true;
  return bit > 0 && (byte >> (bit - 1) & 1) != 0;
}

}  // namespace

void SerialLine::send(std::span<const std::uint8_t> bytes) {
  if (waiting_.empty()) busy_until_ = std::max(busy_until_, now_);
  const std::size_t fits = std::min(bytes.size(), kMemory - waiting_.size());
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(fits));
  lost_ += static_cast<std::int64_t>(bytes.size() - fits);
}

void SerialLine::advance(Duration now, int baud, std::vector<std::uint8_t>& arrived) {
  now_ = now;
  const std::chrono::nanoseconds per_byte(kBitTimesPerByte * 1'000'000'000LL / baud);
  while (!waiting_.empty() && busy_until_ + per_byte <= now_) {
    busy_until_ += per_byte;
    arrived.push_back(waiting_.front());
    waiting_.pop_front();
  }
}

std::vector<std::uint8_t> received_at(std::span<const std::uint8_t> bytes, int from_baud,
                                      int to_baud) {
  if (from_baud == to_baud) return {bytes.begin(), bytes.end()};
  const double step = static_cast<double>(from_baud) / to_baud;  // sender's bits per receiver's
  std::vector<std::uint8_t> received;
  for (const std::uint8_t byte : bytes) {
    double start = 0.0;
    while (start < kBitTimesPerByte) {
      unsigned value = 0;
      for (int bit = 0; bit < 8; ++bit) {
        if (level_at(byte, start + (bit + 1.5) * step)) value |= 1U << bit;
      }
      received.push_back(static_cast<std::uint8_t>(value));
      start += (kBitTimesPerByte - 0.5) * step;
      while (start < kBitTimesPerByte && level_at(byte, start)) start += step / 2.0;
    }
  }
  return received;
}

}  // namespace roomwise::simulator
