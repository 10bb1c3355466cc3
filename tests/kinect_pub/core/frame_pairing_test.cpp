#include "services/kinect_pub/core/frame_pairing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <vector>

namespace roomwise::kinect {
namespace {

using Pairing = FramePairing<int, int>;
constexpr std::int64_t kTolerance_us = 17'000;
constexpr std::int64_t kBetweenImages_us = 33'333;

struct Event {
  bool is_depth;
  std::int64_t time_us;
  int image;
};

std::vector<Pairing::Pair> pairs_of(Pairing& pairing, const std::vector<Event>& events) {
  std::vector<Pairing::Pair> pairs;
  for (const Event& event : events) {
    auto pair = event.is_depth ? pairing.add_depth(event.time_us, event.image)
                               : pairing.add_color(event.time_us, event.image);
    if (pair) pairs.push_back(*pair);
  }
  return pairs;
}

/// Both streams with losses and jitter, in an order of arrival of their own.
std::vector<Event> any_events() {
  std::vector<Event> events;
  std::int64_t depth_us = 0;
  std::int64_t color_us = 0;
  const auto arrivals = *rc::gen::arbitrary<std::vector<bool>>();
  for (const bool is_depth : arrivals) {
    std::int64_t& time_us = is_depth ? depth_us : color_us;
    time_us += *rc::gen::inRange<std::int64_t>(1'000, 80'000);
    events.push_back({is_depth, time_us, static_cast<int>(events.size())});
  }
  return events;
}

RC_GTEST_PROP(FramePairing, PairsAreCloseInOrderAndUseNoImageTwice, ()) {
  Pairing pairing(kTolerance_us);
  const auto pairs = pairs_of(pairing, any_events());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    RC_ASSERT(std::abs(pairs[i].depth_time_us - pairs[i].color_time_us) <= kTolerance_us);
    if (i == 0) continue;
    RC_ASSERT(pairs[i].depth_time_us > pairs[i - 1].depth_time_us);
    RC_ASSERT(pairs[i].color_time_us > pairs[i - 1].color_time_us);
  }
}

RC_GTEST_PROP(FramePairing, EveryImageIsPairedUnpairedOrWaiting, ()) {
  Pairing pairing(kTolerance_us);
  const auto events = any_events();
  const auto pairs = static_cast<std::int64_t>(pairs_of(pairing, events).size());
  const auto depths = std::count_if(events.begin(), events.end(),
                                    [](const Event& event) { return event.is_depth; });
  RC_ASSERT(pairs + pairing.depth_unpaired() +
                static_cast<std::int64_t>(pairing.depths_waiting()) ==
            depths);
  RC_ASSERT(pairs + pairing.color_unpaired() +
                static_cast<std::int64_t>(pairing.colors_waiting()) ==
            static_cast<std::int64_t>(events.size()) - depths);
}

RC_GTEST_PROP(FramePairing, StreamThatRunsAheadStillPairsEveryImage, ()) {
  const auto ahead = *rc::gen::inRange<int>(0, static_cast<int>(Pairing::kWaitingMax));
  const bool depth_first = *rc::gen::arbitrary<bool>();
  Pairing pairing(kTolerance_us);
  std::vector<Event> events;
  for (int i = 0; i < 40 + ahead; ++i) {
    if (i < 40) events.push_back({depth_first, i * kBetweenImages_us, i});
    if (i >= ahead)
      events.push_back({!depth_first, (i - ahead) * kBetweenImages_us + 5'000, i - ahead});
  }
  const auto pairs = pairs_of(pairing, events);
  RC_ASSERT(pairs.size() == 40U);
  for (const auto& pair : pairs) RC_ASSERT(pair.depth == pair.color);
}

RC_GTEST_PROP(FramePairing, LostImageCostsOnlyItsPair, ()) {
  const auto lost = *rc::gen::inRange<int>(0, 20);
  const bool depth_lost = *rc::gen::arbitrary<bool>();
  Pairing pairing(kTolerance_us);
  std::vector<Event> events;
  for (int i = 0; i < 20; ++i) {
    if (i != lost || !depth_lost) events.push_back({true, i * kBetweenImages_us, i});
    if (i != lost || depth_lost) events.push_back({false, i * kBetweenImages_us + 9'000, i});
  }
  const auto pairs = pairs_of(pairing, events);
  RC_ASSERT(pairs.size() == 19U);
  for (const auto& pair : pairs) RC_ASSERT(pair.depth == pair.color);
}

TEST(FramePairing, ToleranceIsIncluded) {
  Pairing pairing(kTolerance_us);
  EXPECT_FALSE(pairing.add_depth(100'000, 1));
  EXPECT_FALSE(pairing.add_color(100'000 - kTolerance_us - 1, 2));
  EXPECT_TRUE(pairing.add_color(100'000 + kTolerance_us, 3));
}

TEST(FramePairing, ClockThatStartsAnewForgetsWhatWaits) {
  Pairing pairing(kTolerance_us);
  EXPECT_FALSE(pairing.add_depth(5'000'000, 1));
  EXPECT_FALSE(pairing.add_depth(0, 2));
  EXPECT_FALSE(pairing.add_color(5'000'000, 3)) << "paired across a restart";
  EXPECT_EQ(pairing.depth_unpaired(), 1);
}

}  // namespace
}  // namespace roomwise::kinect
