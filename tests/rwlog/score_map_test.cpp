#include "logs/tools/score_map.h"

#include <gtest/gtest.h>

#include "tests/rwlog/poses.h"

namespace roomwise {
namespace {

const std::vector<MapPoint> kTruth{{6, {0, 0}}, {7, {3, 0}}, {8, {3, 2}}};

std::vector<MapPoint> seen_from(const Pose2& T_map_world, bool with_identity) {
  std::vector<MapPoint> map;
  for (const MapPoint& point : kTruth) {
    map.push_back({with_identity ? point.identity : -1, transform(T_map_world, point.p_m)});
  }
  return map;
}

RC_GTEST_PROP(ScoreMap, KnownIdentitiesMatchFromAnyFrame, ()) {
  const auto map = seen_from(*any_pose(), true);
  const MatchedMap matched = match_map(map, kTruth, Pose2{});
  const auto score = score_map(matched, Pose2{});
  RC_ASSERT(score->matched == 3U);
  RC_ASSERT(score->map_aligned_m < 1e-9);
}

RC_GTEST_PROP(ScoreMap, UnknownIdentitiesMatchOnceAligned, ()) {
  const Pose2 T_map_world = *any_pose();
  const auto map = seen_from(T_map_world, false);
  const Pose2 T_world_map = inverse(T_map_world);
  const auto score = score_map(match_map(map, kTruth, T_world_map), T_world_map);
  RC_ASSERT(score->matched == 3U);
  RC_ASSERT(score->map_raw_m < 1e-9);
}

TEST(ScoreMap, RawErrorIsThePlacementsError) {
  const auto map = seen_from(Pose2{}, true);
  const auto score = score_map(match_map(map, kTruth, Pose2{}), Pose2{0.3, 0.4, 0.0});
  EXPECT_NEAR(score->map_raw_m, 0.5, 1e-12);
  EXPECT_NEAR(score->map_aligned_m, 0.0, 1e-12);
}

TEST(ScoreMap, NearestIsOneToOneAndNotTooFar) {
  const std::vector<MapPoint> map{{-1, {0.3, 0}},   // farther from 6 than the next
                                  {-1, {0.1, 0}},   // takes 6
                                  {-1, {3, 0.6}},   // too far from 7
                                  {-1, {50, 50}}};  // far from all
  const MatchedMap matched = match_map(map, kTruth, Pose2{});
  ASSERT_EQ(matched.p_map_m.size(), 1U);
  EXPECT_DOUBLE_EQ(matched.p_map_m[0].x(), 0.1);
}

TEST(ScoreMap, AnIdentityCountsOnceAndOnlyIfTrue) {
  const std::vector<MapPoint> map{{6, {0.1, 0}}, {6, {0.0, 0}}, {99, {3, 0}}};
  EXPECT_EQ(match_map(map, kTruth, Pose2{}).p_map_m.size(), 1U);
  EXPECT_FALSE(score_map(match_map({}, kTruth, Pose2{}), Pose2{}));
}

}  // namespace
}  // namespace roomwise
