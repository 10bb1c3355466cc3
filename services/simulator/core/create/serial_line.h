#pragma once
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/time.h"

namespace roomwise::simulator {

/// One direction of a serial line, 8N1: a byte takes ten bit times and arrives when its last has
/// passed. What would wait longer than a transmitter's memory is lost.
class SerialLine {
 public:
  /// Bytes that wait here are sent one after the other from `now` on.
  void send(std::span<const std::uint8_t> bytes);

  /// Appends to `arrived` what has come through by `now` at `baud`.
  void advance(Duration now, int baud, std::vector<std::uint8_t>& arrived);

  void clear() { waiting_.clear(); }
  std::size_t waiting() const { return waiting_.size(); }
  std::int64_t lost() const { return lost_; }

 private:
  static constexpr std::size_t kMemory = 4096;
  std::deque<std::uint8_t> waiting_;
  std::chrono::nanoseconds busy_until_{};  ///< when the last byte that arrived had passed
  std::chrono::nanoseconds now_{};
  std::int64_t lost_ = 0;
};

/// What a receiver set to `to_baud` makes of `bytes` sent at `from_baud`, each sampled bit by bit
/// as a UART does: the same bytes at the same rate, garbage at another.
std::vector<std::uint8_t> received_at(std::span<const std::uint8_t> bytes, int from_baud,
                                      int to_baud);

}  // namespace roomwise::simulator
