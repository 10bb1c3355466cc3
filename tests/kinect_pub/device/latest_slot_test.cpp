#include "services/kinect_pub/device/latest_slot.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace roomwise {
namespace {

TEST(LatestSlot, NewestDisplacesWhatNobodyTook) {
  LatestSlot<int> slot;
  int thing = 1;
  EXPECT_FALSE(slot.put(thing));
  thing = 2;
  EXPECT_TRUE(slot.put(thing));
  EXPECT_TRUE(slot.try_take(thing));
  EXPECT_EQ(thing, 2);
  EXPECT_FALSE(slot.try_take(thing));
}

TEST(LatestSlot, MemoryGoesRound) {
  LatestSlot<std::vector<int>> slot;
  std::vector<int> made(1000, 7);
  const int* const memory = made.data();
  slot.put(made);
  std::vector<int> taken(1000, 0);
  const int* const other = taken.data();
  ASSERT_TRUE(slot.try_take(taken));
  EXPECT_EQ(taken.data(), memory);
  slot.put(made);
  slot.put(made);
  std::vector<int> last;
  ASSERT_TRUE(slot.try_take(last));
  EXPECT_TRUE(made.data() == other || last.data() == other);
}

TEST(LatestSlot, TakingEndsWhenItIsClosed) {
  LatestSlot<int> slot;
  std::thread taker([&] {
    int thing = 0;
    EXPECT_FALSE(slot.take(thing));
  });
  slot.close();
  taker.join();
  int thing = 3;
  slot.put(thing);
  EXPECT_FALSE(slot.take(thing));
}

TEST(LatestSlot, WhatOneThreadTakesOfAnotherIncreasesAndEveryThingIsTakenOrDisplaced) {
  LatestSlot<int> slot;
  constexpr int kThings = 20'000;
  int displaced = 0;
  std::thread maker([&] {
    for (int i = 1; i <= kThings; ++i) {
      int thing = i;
      displaced += slot.put(thing) ? 1 : 0;
    }
  });
  int taken = 0;
  for (int last = 0; last < kThings; ++taken) {
    int thing = 0;
    ASSERT_TRUE(slot.take(thing));
    ASSERT_GT(thing, last);
    last = thing;
  }
  maker.join();
  EXPECT_EQ(taken + displaced, kThings);
}

}  // namespace
}  // namespace roomwise
