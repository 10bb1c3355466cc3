#pragma once
#include <cstdint>

namespace roomwise::kinect {

/// Microseconds from a counter of 60 MHz with 32 bits, which starts over every 71.6 s: the clock of
/// a Kinect v1. Readings may come a little out of order (two streams share the clock); exact while
/// two in a row are less than 35 s apart.
class TickClock {
 public:
  std::int64_t time_us(std::uint32_t ticks) {
    if (!started_) {
      ticks_ = ticks;
      started_ = true;
    }
    ticks_ += static_cast<std::int32_t>(ticks - static_cast<std::uint32_t>(ticks_));
    return ticks_ / kTicksPerUs;
  }

 private:
  static constexpr std::int64_t kTicksPerUs = 60;
  bool started_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace roomwise::kinect
