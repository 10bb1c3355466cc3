#pragma once
#include <chrono>

#include "common/time.h"

namespace roomwise::simulator {

/// Ties the time of a simulated world to this machine's: the world runs by the monotonic clock,
/// what it publishes is stamped by the wall clock as everything else on the bus.
class RealTime {
 public:
  explicit RealTime(Time wall_now)
      : start_(std::chrono::steady_clock::now()), wall_start_(wall_now) {}

  /// How long the world should have lived by now.
  Duration elapsed() const;

  /// Stamp of a moment of the world.
  Time stamp(Duration since_start) const { return wall_start_ + since_start; }

  /// Leaves `skipped` out of the world's life.
  void skip(Duration skipped);

  /// Follows a wall clock that has been set; true if it had.
  bool follow(Time wall_now);

 private:
  std::chrono::steady_clock::time_point start_;
  Time wall_start_;
};

}  // namespace roomwise::simulator
