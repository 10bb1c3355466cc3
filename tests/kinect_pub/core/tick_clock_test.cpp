#include "services/kinect_pub/core/tick_clock.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace roomwise::kinect {
namespace {

RC_GTEST_PROP(TickClock, GoesOnWhereTheCounterStartsOver, ()) {
  const auto first = *rc::gen::arbitrary<std::uint32_t>();
  const auto steps = *rc::gen::container<std::vector<std::int64_t>>(
      rc::gen::inRange<std::int64_t>(-60'000'000, 35LL * 60'000'000));
  TickClock clock;
  std::int64_t ticks = first;
  RC_ASSERT(clock.time_us(first) == ticks / 60);
  for (const std::int64_t step : steps) {
    ticks += step;
    RC_ASSERT(clock.time_us(static_cast<std::uint32_t>(ticks)) == ticks / 60);
  }
}

}  // namespace
}  // namespace roomwise::kinect
