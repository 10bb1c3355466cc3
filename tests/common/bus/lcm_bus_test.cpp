#include "common/bus/lcm_bus.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "common/bus/lcm_url.h"

namespace roomwise {
namespace {

/// Publishes `poses` poses to itself, then runs until the handler has seen the last one.
std::vector<std::int64_t> seqs_handled(LcmBus& bus, int poses, Delivery delivery) {
  std::vector<std::int64_t> seen;
  bus.subscribe(
      channels::kPose,
      [&](const pose_t& pose) {
        seen.push_back(pose.seq);
        if (pose.seq == poses) bus.stop();
      },
      delivery);
  pose_t pose{};
  for (int i = 0; i < poses; ++i) bus.publish(channels::kPose, pose);
  bus.run();
  return seen;
}

TEST(LcmBus, HandsOutEveryMessageInOrder) {
  LcmBus bus("memq://");
  const auto seen = seqs_handled(bus, 200, Delivery::kEvery);
  ASSERT_EQ(seen.size(), 200U);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
}

TEST(LcmBus, LatestHandsOutOnlyTheNewestAndCountsTheRest) {
  LcmBus bus("memq://");
  EXPECT_EQ(seqs_handled(bus, 9, Delivery::kLatest), std::vector<std::int64_t>{9});
  EXPECT_EQ(bus.statistics().channels.find("POSE")->second.skipped, 8);
}

TEST(LcmBus, TicksWithNominalTimes) {
  LcmBus bus("memq://");
  std::vector<std::int64_t> ticks;
  bus.every(std::chrono::milliseconds(5), [&](Time time) {
    ticks.push_back(utime_of(time));
    if (ticks.size() == 4) bus.stop();
  });
  bus.run();
  for (const std::int64_t tick : ticks) EXPECT_EQ(tick % 5000, 0);
  EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
}

TEST(LcmBus, PostedWorkRunsInOrderOnTheThreadInRun) {
  LcmBus bus("memq://");
  std::vector<int> done;
  std::thread poster([&] {
    for (int i = 0; i < 100; ++i) {
      bus.post([&, i] {
        EXPECT_NE(std::this_thread::get_id(), poster.get_id());
        done.push_back(i);
        if (i == 99) bus.stop();
      });
    }
  });
  bus.run();
  poster.join();
  ASSERT_EQ(done.size(), 100U);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

TEST(LcmBus, PostedWorkMayPostMore) {
  LcmBus bus("memq://");
  bus.post([&] { bus.post([&] { bus.stop(); }); });
  bus.run();
}

TEST(LcmBus, StopsFromAnotherThread) {
  LcmBus bus("memq://");
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    bus.stop();
  });
  bus.run();
  stopper.join();
}

TEST(LcmBus, RefusesAUrlByName) {
  try {
    LcmBus bus("nonsense://");
    FAIL() << "opened";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense://"), std::string::npos);
  }
}

TEST(LcmUrl, StaysOnThisMachineAndWithinWhatTheKernelAllows) {
  EXPECT_EQ(local_lcm_url(212'992), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=212992");
  EXPECT_EQ(local_lcm_url(1 << 30), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152");
}

}  // namespace
}  // namespace roomwise
