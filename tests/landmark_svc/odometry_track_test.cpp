#include "services/landmark_svc/odometry_track.h"

#include <gtest/gtest.h>

#include <limits>

namespace roomwise {
namespace {

odometry_t odometry(std::int64_t utime, double x_m, std::int32_t reset_counter = 0) {
  odometry_t message{};
  message.utime = utime;
  message.x_m = x_m;
  message.reset_counter = reset_counter;
  return message;
}

using Result = OdometryTrack::Result;

TEST(OdometryTrack, InterpolatesAndGoesOnForATenthOfASecond) {
  OdometryTrack track;
  EXPECT_FALSE(track.at(0));
  ASSERT_EQ(track.take(odometry(1'000'000, 1.0)), Result::kOk);
  EXPECT_FALSE(track.at(1'000'000));
  ASSERT_EQ(track.take(odometry(1'100'000, 2.0)), Result::kOk);
  EXPECT_NEAR(track.at(1'050'000)->x_m, 1.5, 1e-9);
  EXPECT_NEAR(track.at(1'200'000)->x_m, 3.0, 1e-9);
  EXPECT_FALSE(track.at(1'200'001));
  EXPECT_FALSE(track.at(999'999));
  EXPECT_FALSE(track.at(std::numeric_limits<std::int64_t>::min()));
}

TEST(OdometryTrack, ForgetsWhenCountingOrTimeStartsAnew) {
  OdometryTrack track;
  ASSERT_EQ(track.take(odometry(1'000'000, 1.0)), Result::kOk);
  ASSERT_EQ(track.take(odometry(1'100'000, 2.0)), Result::kOk);
  EXPECT_EQ(track.take(odometry(1'200'000, 0.0, 1)), Result::kStartedAnew);
  EXPECT_FALSE(track.at(1'150'000));
  EXPECT_EQ(track.take(odometry(1'200'000, 0.0, 1)), Result::kStartedAnew);
}

TEST(OdometryTrack, RefusesWhatIsNoPose) {
  OdometryTrack track;
  EXPECT_EQ(track.take(odometry(1, std::numeric_limits<double>::quiet_NaN())), Result::kNotUsable);
  EXPECT_EQ(track.take(odometry(1, 1e300)), Result::kNotUsable);
  EXPECT_EQ(track.take(odometry(-1, 0.0)), Result::kNotUsable);
  EXPECT_EQ(track.take(odometry(std::numeric_limits<std::int64_t>::max(), 0.0)),
            Result::kNotUsable);
}

}  // namespace
}  // namespace roomwise
