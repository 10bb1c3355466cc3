#pragma once
#include "common/create/open_interface.h"
#include "common/time.h"

namespace roomwise::create {

/// Dates stream frames: the robot read its sensors before it sent the frame, and frames that arrive
/// together were sent 15 ms apart. Times grow strictly, unless the clock was set back by a second
/// or more.
class FrameTimes {
 public:
  /// `transfer`: how long a frame is on the line.
  explicit FrameTimes(Duration transfer) : transfer_(transfer) {}

  /// When a frame was measured that arrived at `arrival` with `frames_after` more behind it.
  Time date(Time arrival, std::size_t frames_after) {
    const Duration behind{kSensorPeriod_us * static_cast<Duration::rep>(frames_after)};
    const Time time = arrival - transfer_ - behind;
    const bool clock_was_set = last_ - time > kSetBack;
    last_ = clock_was_set || time > last_ ? time : last_ + kLeastStep;
    return last_;
  }

 private:
  static constexpr Duration kSetBack = std::chrono::seconds(1);
  static constexpr Duration kLeastStep = std::chrono::milliseconds(1);
  Duration transfer_;
  Time last_{};
};

}  // namespace roomwise::create
