#include "services/kinect_pub/core/clock_mapping.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

namespace roomwise::kinect {
namespace {

constexpr std::int64_t kPeriod_us = 33'333;
constexpr std::int64_t kEpoch_us = 1'700'000'000'000'000;

/// A frame at device time `device_us` that arrives late by a delay of its own.
struct Arrival {
  std::int64_t device_us;
  std::int64_t host_us;
};

/// Frames at 30 Hz on a clock `offset_us` behind the host's, each as late as `delays_us` says.
std::vector<Arrival> arrivals(std::int64_t first_device_us, std::int64_t offset_us,
                              const std::vector<int>& delays_us) {
  std::vector<Arrival> made;
  std::int64_t device_us = first_device_us;
  for (const int delay_us : delays_us) {
    made.push_back({device_us, device_us + offset_us + delay_us});
    device_us += kPeriod_us;
  }
  return made;
}

auto any_delays() {
  return rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 300'000)));
}

RC_GTEST_PROP(ClockMapping, IsLateByTheSmallestDelaySeenSoFar, ()) {
  const auto delays_us = *any_delays();
  const auto device_us = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000);
  ClockMapping clock({});
  int smallest_us = delays_us[0];
  for (std::size_t i = 0; i < std::min<std::size_t>(delays_us.size(), 250); ++i) {
    smallest_us = std::min(smallest_us, delays_us[i]);
    const Arrival frame = arrivals(device_us, kEpoch_us, delays_us)[i];
    clock.map(frame.device_us, frame.host_us);
    RC_ASSERT(clock.offset_us() == kEpoch_us + smallest_us);
  }
}

RC_GTEST_PROP(ClockMapping, TimesIncreaseAndLieNoLaterThanArrival, ()) {
  ClockMapping clock({});
  std::int64_t last_us = 0;
  for (const Arrival& frame : arrivals(0, kEpoch_us, *any_delays())) {
    const std::int64_t mapped_us = clock.map(frame.device_us, frame.host_us);
    RC_ASSERT(mapped_us > last_us);
    RC_ASSERT(mapped_us <= std::max(frame.host_us, last_us + 1));
    last_us = mapped_us;
  }
  RC_ASSERT(clock.restarts() == 0);
}

RC_GTEST_PROP(ClockMapping, ShiftingTheDeviceClockChangesNothing, ()) {
  const auto delays_us = *any_delays();
  const auto shift_us = *rc::gen::inRange<std::int64_t>(-1'000'000'000, 1'000'000'000);
  ClockMapping clock({});
  ClockMapping shifted({});
  for (const Arrival& frame : arrivals(0, kEpoch_us, delays_us)) {
    RC_ASSERT(clock.map(frame.device_us, frame.host_us) ==
              shifted.map(frame.device_us + shift_us, frame.host_us));
  }
}

RC_GTEST_PROP(ClockMapping, ShiftingTheHostClockShiftsTheResult, ()) {
  const auto delays_us = *any_delays();
  const auto shift_us = *rc::gen::inRange<std::int64_t>(-1'000'000'000, 1'000'000'000);
  ClockMapping clock({});
  ClockMapping shifted({});
  for (const Arrival& frame : arrivals(0, kEpoch_us, delays_us)) {
    RC_ASSERT(clock.map(frame.device_us, frame.host_us) + shift_us ==
              shifted.map(frame.device_us, frame.host_us + shift_us));
  }
}

RC_GTEST_PROP(ClockMapping, RestartOfTheDeviceClockIsSurvivedAtOnce, ()) {
  const auto before_us = *any_delays();
  const auto after_us = *any_delays();
  ClockMapping clock({});
  std::int64_t last_us = 0;
  for (const Arrival& frame : arrivals(3'600'000'000, kEpoch_us, before_us)) {
    last_us = clock.map(frame.device_us, frame.host_us);
  }
  // The clock starts from zero, a second later at the host.
  const std::int64_t offset_us =
      kEpoch_us + 3'601'000'000 + kPeriod_us * static_cast<std::int64_t>(before_us.size());
  for (const Arrival& frame : arrivals(0, offset_us, after_us)) {
    const std::int64_t mapped_us = clock.map(frame.device_us, frame.host_us);
    RC_ASSERT(mapped_us > last_us);
    RC_ASSERT(mapped_us <= std::max(frame.host_us, last_us + 1));
    last_us = mapped_us;
  }
  RC_ASSERT(clock.restarts() == 1);
}

TEST(ClockMapping, FollowsCrystalsThatDriftApart) {
  ClockMapping clock({.window_us = 10'000'000});
  for (const double drift : {100e-6, -100e-6}) {
    for (std::int64_t i = 0; i < 30 * 600; ++i) {
      const std::int64_t device_us = 7'000'000'000 * (drift < 0 ? 2 : 1) + i * kPeriod_us;
      const auto true_us =
          kEpoch_us + static_cast<std::int64_t>(static_cast<double>(device_us) * (1.0 + drift));
      const std::int64_t delay_us = 2'000 + (i % 7) * 3'000;
      const std::int64_t mapped_us = clock.map(device_us, true_us + delay_us);
      if (i < 30 || drift < 0) continue;
      // Two windows of drift at most, beside the smallest delay.
      ASSERT_NEAR(static_cast<double>(mapped_us - true_us), 2'000.0, 2'100.0) << "frame " << i;
    }
  }
}

TEST(ClockMapping, HostClockSetBackIsFollowed) {
  ClockMapping clock({});
  clock.map(1'000'000, kEpoch_us);
  const std::int64_t hour_us = 3'600'000'000;
  EXPECT_EQ(clock.map(1'033'333, kEpoch_us + 33'333 - hour_us), kEpoch_us + 33'333 - hour_us);
  EXPECT_EQ(clock.restarts(), 1);
}

TEST(ClockMapping, ExposureDelayIsTakenOff) {
  ClockMapping clock({.exposure_delay_us = 20'000});
  EXPECT_EQ(clock.map(0, kEpoch_us), kEpoch_us - 20'000);
}

RC_GTEST_PROP(ClockMapping, AnyTimesAtAllAreHarmless, ()) {
  ClockMapping clock({});
  for (const auto device_us : *rc::gen::arbitrary<std::vector<std::int64_t>>()) {
    clock.map(device_us, *rc::gen::arbitrary<std::int64_t>());
    clock.map(std::numeric_limits<std::int64_t>::min(), device_us);
    clock.map(std::numeric_limits<std::int64_t>::max(), device_us);
  }
}

}  // namespace
}  // namespace roomwise::kinect
