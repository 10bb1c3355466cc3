// Who is heard, when an input counts, and when a stop may be reset: every limit from both sides.
#include <gtest/gtest.h>

#include <limits>

#include "services/safety_svc/core/estop_latch.h"
#include "services/safety_svc/core/input_watch.h"
#include "services/safety_svc/core/request_arbiter.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Instant kStart{seconds(100), time_from_utime(1'700'000'000'000'000)};

Instant later(Duration time) { return {kStart.steady + time, kStart.wall + time}; }

Asked ask(std::string_view source, int priority, double speed_mps = 0.1) {
  return {.request = {speed_mps, 0.0},
          .source = source,
          .priority = priority,
          .valid_for = milliseconds(200),
          .decided = kStart.wall};
}

TEST(RequestArbiter, NobodyIsHeardAtFirst) { EXPECT_EQ(RequestArbiter().winner(kStart), nullptr); }

TEST(RequestArbiter, TheHighestPriorityThatLivesIsHeardAndOfEqualsTheFirst) {
  RequestArbiter arbiter;
  EXPECT_EQ(arbiter.hear(kStart, ask("pilot", 10)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.hear(kStart, ask("other", 10)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.winner(kStart)->source, "pilot");
  EXPECT_EQ(arbiter.hear(kStart, ask("person", 50)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.winner(kStart)->source, "person");
  EXPECT_EQ(arbiter.winner(later(milliseconds(199)))->source, "person");
  EXPECT_EQ(arbiter.winner(later(milliseconds(200))), nullptr);
}

TEST(RequestArbiter, WhoFellSilentIsHeardAfterWhoAsksAgainFirst) {
  RequestArbiter arbiter;
  EXPECT_EQ(arbiter.hear(kStart, ask("pilot", 10)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.hear(kStart, ask("other", 10)), RequestResult::kHeard);
  const Instant silent = later(milliseconds(200));
  EXPECT_EQ(arbiter.hear(silent, ask("other", 10)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.hear(silent, ask("pilot", 10)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.winner(silent)->source, "other");
}

TEST(RequestArbiter, ANewerRequestReplacesItsSourcesOlder) {
  RequestArbiter arbiter;
  EXPECT_EQ(arbiter.hear(kStart, ask("pilot", 10, 0.1)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.hear(kStart, ask("pilot", 5, 0.2)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.winner(kStart)->request.speed_mps, 0.2);
  EXPECT_EQ(arbiter.winner(kStart)->priority, 5);
}

TEST(RequestArbiter, NoRequestLivesLongerThanASecond) {
  RequestArbiter arbiter;
  Asked asked = ask("pilot", 10);
  asked.valid_for = Duration(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(arbiter.hear(kStart, asked), RequestResult::kHeard);
  EXPECT_NE(arbiter.winner(later(kRequestLife - Duration(1))), nullptr);
  EXPECT_EQ(arbiter.winner(later(kRequestLife)), nullptr);
}

TEST(RequestArbiter, WhatMakesNoSenseTakesTheOlderBack) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto result = [](auto change) {
    RequestArbiter arbiter;
    EXPECT_EQ(arbiter.hear(kStart, ask("pilot", 10)), RequestResult::kHeard);
    Asked asked = ask("pilot", 10);
    change(asked);
    const RequestResult heard = arbiter.hear(kStart, asked);
    EXPECT_EQ(arbiter.winner(kStart)->is_bad, heard != RequestResult::kHeard);
    EXPECT_EQ(arbiter.winner(later(kRequestLife)), nullptr);
    return heard;
  };
  EXPECT_EQ(result([&](Asked& a) { a.request.speed_mps = nan; }), RequestResult::kNotFinite);
  EXPECT_EQ(result([&](Asked& a) { a.request.turn_rate_radps = nan; }), RequestResult::kNotFinite);
  EXPECT_EQ(result([](Asked& a) { a.request.speed_mps = 10.0; }), RequestResult::kHeard);
  EXPECT_EQ(result([](Asked& a) { a.request.speed_mps = -10.1; }), RequestResult::kOutOfRange);
  EXPECT_EQ(result([](Asked& a) { a.request.turn_rate_radps = 100.0; }), RequestResult::kHeard);
  EXPECT_EQ(result([](Asked& a) { a.request.turn_rate_radps = 101.0; }),
            RequestResult::kOutOfRange);
  EXPECT_EQ(result([](Asked& a) { a.priority = 0; }), RequestResult::kHeard);
  EXPECT_EQ(result([](Asked& a) { a.priority = -1; }), RequestResult::kOutOfRange);
  EXPECT_EQ(result([](Asked& a) { a.priority = 100; }), RequestResult::kHeard);
  EXPECT_EQ(result([](Asked& a) { a.priority = 101; }), RequestResult::kOutOfRange);
  EXPECT_EQ(result([](Asked& a) { a.valid_for = Duration(1); }), RequestResult::kHeard);
  EXPECT_EQ(result([](Asked& a) { a.valid_for = Duration(0); }), RequestResult::kOutOfRange);
  EXPECT_EQ(result([](Asked& a) { a.decided += kFutureSlack; }), RequestResult::kHeard);
  EXPECT_EQ(result([](Asked& a) { a.decided += kFutureSlack + Duration(1); }),
            RequestResult::kFromFuture);
}

TEST(RequestArbiter, ARecordingChangesNothing) {
  RequestArbiter arbiter;
  Asked asked = ask("pilot", 10);
  asked.decided -= kStampAge;
  EXPECT_EQ(arbiter.hear(kStart, asked), RequestResult::kHeard);
  asked.decided -= Duration(1);
  asked.request.speed_mps = 0.4;
  EXPECT_EQ(arbiter.hear(kStart, asked), RequestResult::kOld);
  EXPECT_EQ(arbiter.winner(kStart)->request.speed_mps, 0.1);
}

TEST(RequestArbiter, HasPlaceForEightSourcesAndGivesItToTheLiving) {
  RequestArbiter arbiter;
  for (const char* source : {"a", "b", "c", "d", "e", "f", "g", "h"}) {
    EXPECT_EQ(arbiter.hear(kStart, ask(source, 10)), RequestResult::kHeard);
  }
  EXPECT_EQ(arbiter.hear(kStart, ask("i", 90)), RequestResult::kTooManySources);
  EXPECT_EQ(arbiter.hear(kStart, ask("h", 90)), RequestResult::kHeard);
  Asked asked = ask("i", 90);
  asked.decided += milliseconds(200);
  EXPECT_EQ(arbiter.hear(later(milliseconds(200)), asked), RequestResult::kHeard);
  const std::string long_name(RequestArbiter::kSourceLetters, 'x');
  EXPECT_EQ(arbiter.hear(later(milliseconds(400)), ask(long_name, 90)), RequestResult::kHeard);
  EXPECT_EQ(arbiter.hear(later(milliseconds(400)), ask(long_name + "x", 90)),
            RequestResult::kTooManySources);
}

TEST(InputWatch, IsFreshUpToItsAgeAndSaysIt) {
  InputWatch watch;
  EXPECT_FALSE(watch.is_fresh(kStart, seconds(9)));
  EXPECT_EQ(watch.age_s(kStart), -1.0);
  EXPECT_EQ(watch.hear(kStart, kStart.wall), StampResult::kFresh);
  EXPECT_TRUE(watch.is_fresh(later(milliseconds(100)), milliseconds(100)));
  EXPECT_FALSE(watch.is_fresh(later(milliseconds(101)), milliseconds(100)));
  EXPECT_DOUBLE_EQ(watch.age_s(later(milliseconds(250))), 0.25);
}

TEST(InputWatch, HearsOnAfterTheClockWasSetBack) {
  InputWatch watch;
  ASSERT_EQ(watch.hear(kStart, kStart.wall), StampResult::kFresh);
  const Instant set_back{kStart.steady + Duration(1), kStart.wall - std::chrono::hours(1)};
  EXPECT_EQ(watch.hear(set_back, set_back.wall), StampResult::kFresh);
  EXPECT_EQ(watch.hear(set_back, set_back.wall), StampResult::kOutOfOrder);
}

TEST(InputWatch, UsesNoStampThatCannotBeTrue) {
  InputWatch watch;
  EXPECT_EQ(watch.hear(kStart, kStart.wall + kFutureSlack + Duration(1)), StampResult::kFromFuture);
  EXPECT_TRUE(watch.is_distrusted(later(kDistrust - Duration(1))));
  EXPECT_FALSE(watch.is_distrusted(later(kDistrust)));
  EXPECT_EQ(watch.hear(kStart, kStart.wall - kStampAge - Duration(1)), StampResult::kOld);
  EXPECT_FALSE(watch.is_fresh(kStart, seconds(9)));
  EXPECT_EQ(watch.hear(kStart, kStart.wall - kStampAge), StampResult::kFresh);
  EXPECT_EQ(watch.hear(kStart, kStart.wall - kStampAge), StampResult::kOutOfOrder);
  EXPECT_EQ(watch.hear(kStart, kStart.wall + kFutureSlack), StampResult::kFresh);
  EXPECT_EQ(watch.hear(kStart, kStart.wall + kFutureSlack), StampResult::kOutOfOrder)
      << "as far ahead as a stamp may be, the clock was not set back";
}

TEST(ClockWatch, NoticesAStepAndForgivesASlew) {
  for (const int sign : {-1, 1}) {
    ClockWatch clock;
    clock.tick(kStart);
    EXPECT_FALSE(clock.is_distrusted(kStart));
    Instant now{kStart.steady + seconds(1), kStart.wall + seconds(1) + sign * kClockStep};
    clock.tick(now);
    EXPECT_FALSE(clock.is_distrusted(now));
    now.wall += sign * (kClockStep + Duration(1));
    clock.tick(now);
    EXPECT_TRUE(clock.is_distrusted(now));
    now.steady += kDistrust;
    EXPECT_FALSE(clock.is_distrusted(now));
  }
}

TEST(EstopLatch, IsResetByItsOwnIdWhenAllIsCalm) {
  EstopLatch latch;
  EXPECT_FALSE(latch.is_latched());
  EXPECT_EQ(latch.reset(kStart, 0, true), ResetResult::kNotLatched);
  latch.press(kStart, false);
  const std::int64_t id = latch.latch_id();
  EXPECT_EQ(id, utime_of(kStart.wall)) << "of the clock: none from before a restart";
  EXPECT_EQ(latch.reset(kStart, id + 1, true), ResetResult::kOtherLatch);
  EXPECT_EQ(latch.reset(kStart, id, false), ResetResult::kNotCalm);
  EXPECT_TRUE(latch.is_latched());
  EXPECT_EQ(latch.reset(kStart, id, true), ResetResult::kReset);
  EXPECT_FALSE(latch.is_latched());
}

TEST(EstopLatch, IsNotResetWhileHeld) {
  EstopLatch latch;
  latch.press(kStart, true);
  const std::int64_t id = latch.latch_id();
  EXPECT_EQ(latch.reset(later(kEstopHeld - Duration(1)), id, true), ResetResult::kStillHeld);
  latch.press(later(kEstopHeld), true);
  EXPECT_EQ(latch.latch_id(), id);
  EXPECT_EQ(latch.reset(later(kEstopHeld + kEstopHeld), id, true), ResetResult::kReset);
}

TEST(EstopLatch, NoIdComesTwice) {
  EstopLatch latch;
  latch.press(kStart, false);
  const std::int64_t first = latch.latch_id();
  ASSERT_EQ(latch.reset(kStart, first, true), ResetResult::kReset);
  latch.press({kStart.steady, kStart.wall - seconds(9)}, false);
  EXPECT_EQ(latch.latch_id(), first + 1);
}

}  // namespace
}  // namespace roomwise::safety
