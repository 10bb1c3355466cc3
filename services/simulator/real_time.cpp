#include "services/simulator/real_time.h"

namespace roomwise::simulator {
namespace {

/// Two clocks are read one after the other: less than this apart is no step of the wall clock.
constexpr Duration kClockStep{100'000};

}  // namespace

Duration RealTime::elapsed() const {
  return std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start_);
}

void RealTime::skip(Duration skipped) {
  start_ += skipped;
  wall_start_ += skipped;
}

bool RealTime::follow(Time wall_now) {
  const Duration ahead = wall_now - stamp(elapsed());
  if (std::chrono::abs(ahead) < kClockStep) return false;
  wall_start_ += ahead;
  return true;
}

}  // namespace roomwise::simulator
