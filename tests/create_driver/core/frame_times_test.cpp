#include "services/create_driver/core/frame_times.h"

#include <gtest/gtest.h>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kNow = time_from_utime(1'700'000'000'000'000);

TEST(FrameTimes, AFrameWasMeasuredBeforeItWasSent) {
  FrameTimes times(milliseconds(7));
  EXPECT_EQ(times.date(kNow, 0), kNow - milliseconds(7));
}

TEST(FrameTimes, FramesThatArriveTogetherAreFifteenMillisecondsApart) {
  FrameTimes times(milliseconds(0));
  EXPECT_EQ(times.date(kNow, 2), kNow - milliseconds(30));
  EXPECT_EQ(times.date(kNow, 1), kNow - milliseconds(15));
  EXPECT_EQ(times.date(kNow, 0), kNow);
}

TEST(FrameTimes, GrowThoughFramesArriveLateAndThenTooClose) {
  FrameTimes times(milliseconds(0));
  const Time late = times.date(kNow, 0);
  EXPECT_GT(times.date(kNow + milliseconds(2), 1), late);
  EXPECT_GT(times.date(kNow + milliseconds(2), 0), late + milliseconds(1));
}

TEST(FrameTimes, FollowAClockThatWasSetBack) {
  FrameTimes times(milliseconds(0));
  times.date(kNow, 0);
  EXPECT_EQ(times.date(kNow - seconds(3600), 0), kNow - seconds(3600));
}

}  // namespace
}  // namespace roomwise::create
