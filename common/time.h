#pragma once
#include <chrono>
#include <cstdint>

namespace roomwise {

/// Microseconds since the epoch: when something was measured. Only LcmBus asks a clock for it.
using Time = std::chrono::time_point<std::chrono::system_clock, std::chrono::microseconds>;
using Duration = std::chrono::microseconds;

constexpr Time time_from_utime(std::int64_t utime) { return Time{Duration{utime}}; }
constexpr std::int64_t utime_of(Time time) { return time.time_since_epoch().count(); }
constexpr double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// The first multiple of `period` after `time`, counted from the epoch; `time` may lie before it.
constexpr Time next_multiple(Time time, Duration period) {
  const Duration rest = (time.time_since_epoch() % period + period) % period;
  return time + (period - rest);
}

}  // namespace roomwise
