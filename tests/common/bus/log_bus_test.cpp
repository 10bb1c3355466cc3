#include "common/bus/log_bus.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <stdexcept>

#include "tests/support/events.h"

namespace roomwise {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

pose_t pose_at(std::int64_t utime, std::int64_t seq) {
  pose_t pose{};
  pose.utime = utime;
  pose.seq = seq;
  return pose;
}

class LogBusTest : public ::testing::Test {
 protected:
  void add_pose(std::int64_t utime, std::int64_t seq) {
    input_.push_back(event_of(channels::kPose, utime, pose_at(utime, seq)));
  }
  const ChannelStatistics& pose_statistics() {
    return bus_.statistics().channels.find("POSE")->second;
  }
  std::vector<LogEvent> input_;
  std::vector<LogEvent> output_;
  LogBus bus_{input_, output_};
};

TEST_F(LogBusTest, HandsOutMessagesInOrderAtTheirTime) {
  add_pose(10, 1);
  add_pose(20, 2);
  std::vector<std::int64_t> seen;
  bus_.subscribe(channels::kPose, [&](const pose_t& pose) {
    EXPECT_EQ(utime_of(bus_.now()), pose.utime);
    seen.push_back(pose.utime);
  });
  bus_.run();
  EXPECT_EQ(seen, (std::vector<std::int64_t>{10, 20}));
}

TEST_F(LogBusTest, RefusesWorkOfOtherThreads) {
  EXPECT_THROW(bus_.post([] {}), std::logic_error);
}

TEST_F(LogBusTest, NumbersAndStampsWhatItPublishes) {
  add_pose(1000, 1);
  bus_.subscribe(channels::kPose, [&](const pose_t&) {
    odometry_t odometry{};
    bus_.publish(channels::kOdometry, odometry);
    bus_.publish(channels::kOdometry, odometry);
  });
  bus_.run();
  ASSERT_EQ(output_.size(), 2U);
  EXPECT_EQ(utime_of(output_[1].time), 1000);
  odometry_t second;
  ASSERT_EQ(decode(output_[1].data, second), DecodeResult::kOk);
  EXPECT_EQ(second.seq, 2);
}

TEST_F(LogBusTest, TicksAtWholeMultiplesBeforeLaterMessages) {
  add_pose(1'500'000, 1);
  add_pose(4'000'000, 2);
  std::vector<std::int64_t> order;
  bus_.subscribe(channels::kPose, [&](const pose_t& pose) { order.push_back(pose.utime); });
  bus_.every(seconds(1), [&](Time time) { order.push_back(-utime_of(time)); });
  bus_.run();
  EXPECT_EQ(order,
            (std::vector<std::int64_t>{1'500'000, -2'000'000, -3'000'000, -4'000'000, 4'000'000}));
}

TEST_F(LogBusTest, DoesNotTickThroughAHoleOfYears) {
  add_pose(0, 1);
  add_pose(std::numeric_limits<std::int64_t>::max(), 2);
  add_pose(std::numeric_limits<std::int64_t>::min(), 3);
  int ticks = 0;
  bus_.subscribe(channels::kPose, [](const pose_t&) {});
  bus_.every(milliseconds(10), [&](Time) { ++ticks; });
  bus_.run();
  EXPECT_LE(ticks, 1);
}

TEST_F(LogBusTest, CountsGapsAndRestartsOfSeq) {
  for (const std::int64_t seq : {5, 6, 9, 1, 2}) add_pose(0, seq);
  bus_.subscribe(channels::kPose, [](const pose_t&) {});
  bus_.run();
  EXPECT_EQ(pose_statistics().received, 5);
  EXPECT_EQ(pose_statistics().missed, 2);
  EXPECT_EQ(pose_statistics().restarts, 1);
}

TEST_F(LogBusTest, SurvivesAbsurdSeq) {
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t seq : {std::int64_t{1}, kLargest, std::int64_t{1}, kLargest,
                                 std::numeric_limits<std::int64_t>::min()}) {
    add_pose(0, seq);
  }
  bus_.subscribe(channels::kPose, [](const pose_t&) {});
  bus_.run();
  EXPECT_EQ(pose_statistics().missed, kLargest);
}

TEST_F(LogBusTest, CountsForeignAndDamagedMessagesAndHandsOnTheRest) {
  add_pose(0, 1);
  LogEvent foreign = input_.front();
  foreign.data[0] ^= 1U;
  LogEvent cut = input_.front();
  cut.data.pop_back();
  input_ = {foreign, cut, input_.front()};
  int handled = 0;
  bus_.subscribe(channels::kPose, [&](const pose_t&) { ++handled; });
  bus_.run();
  EXPECT_EQ(handled, 1);
  EXPECT_EQ(pose_statistics().undecodable, 2);
}

TEST_F(LogBusTest, LetsAHandlersExceptionOut) {
  add_pose(0, 1);
  bus_.subscribe(channels::kPose, [](const pose_t&) { throw std::logic_error("a bug"); });
  EXPECT_THROW(bus_.run(), std::logic_error);
}

TEST_F(LogBusTest, RefusesASecondHandler) {
  bus_.subscribe(channels::kPose, [](const pose_t&) {});
  EXPECT_THROW(bus_.subscribe(channels::kPose, [](const pose_t&) {}), std::logic_error);
}

TEST_F(LogBusTest, RefusesToPublishACountThatLies) {
  landmark_map_t map{};
  map.map_count = 1;
  EXPECT_THROW(bus_.publish(channels::kLandmarkMap, map), std::logic_error);
}

}  // namespace
}  // namespace roomwise
