#pragma once
#include <algorithm>
#include <chrono>

namespace roomwise::kinect {

/// How long to wait before trying a device again: doubling from a tenth of a second, at most one
/// second, so that a device that is back is in use within three.
class ReopenBackoff {
 public:
  static constexpr std::chrono::milliseconds kShortest{100};
  static constexpr std::chrono::milliseconds kLongest{1000};

  std::chrono::milliseconds next() {
    const std::chrono::milliseconds now = wait_;
    wait_ = std::min(2 * wait_, kLongest);
    return now;
  }
  void reset() { wait_ = kShortest; }

 private:
  std::chrono::milliseconds wait_ = kShortest;
};

}  // namespace roomwise::kinect
