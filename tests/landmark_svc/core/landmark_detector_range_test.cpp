#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/landmark_svc/support/kinect_effects.h"
#include "tests/support/synthetic_room.h"

namespace roomwise::landmark {
namespace {

RgbdFrame far_view(const SyntheticRoom& room, std::uint32_t seed) {
  RgbdFrame frame = render(room, {}, {}, seed);
  add_projector_shadow(frame.depth, 351.0);
  add_ragged_edges(frame.depth, seed);
  add_dropouts(frame.depth, 0.01, seed);
  return frame;
}

std::vector<Landmark> seen_in(const SyntheticRoom& room) {
  LandmarkDetector detector{LandmarkParams{}};
  EXPECT_EQ(detector.detect(far_view(room, 3)), DetectResult::kOk);
  return detector.landmarks();
}

bool is_occluding(const Landmark& landmark) {
  return landmark.kind == LandmarkKind::kEdgeLeft || landmark.kind == LandmarkKind::kEdgeRight;
}

TEST(LandmarkDetectorRange, ADoorwayHasItsPostsThoughWhatLiesBehindIsTooFarForADepth) {
  const SyntheticRoom doorway{.boxes = {{.low_m = {2.5, -2.0, 0.0}, .high_m = {2.6, -0.45, 2.5}},
                                        {.low_m = {2.5, 0.45, 0.0}, .high_m = {2.6, 2.0, 2.5}},
                                        {.low_m = {6.0, -4.0, 0.0}, .high_m = {6.1, 4.0, 2.5}}}};
  SyntheticRoom wall_before_a_void = doorway;
  wall_before_a_void.has_floor = false;
  int posts = 0;
  for (const Landmark& landmark : seen_in(doorway)) {
    const double x_m = landmark.range_m * std::cos(landmark.bearing_rad);
    const double y_m = landmark.range_m * std::sin(landmark.bearing_rad);
    EXPECT_LT(std::abs(std::abs(y_m) - 0.45), 0.03);
    EXPECT_GT(x_m, 2.45);
    EXPECT_LT(x_m, 2.65);
    posts += is_occluding(landmark) && landmark.height_high_m > 0.7 ? 1 : 0;
  }
  EXPECT_EQ(posts, 2);
  const auto unproven = seen_in(wall_before_a_void);
  EXPECT_TRUE(std::none_of(unproven.begin(), unproven.end(), is_occluding));
}

/// Window matching misplaces the border row by row, so that the readings beside it are of places
/// further in, which on a wall along the way are nearer.
TEST(LandmarkDetectorRange, TheEndOfAWallAlongTheWayIsWhereItIs) {
  const Eigen::Vector2d end_m(2.0, 0.5);
  const SyntheticRoom room{.boxes = {{.low_m = {0.5, end_m.y(), 0.0}, .high_m = {2.0, 0.8, 1.0}},
                                     {.low_m = {3.5, -4.0, 0.0}, .high_m = {3.6, 4.0, 2.5}}}};
  constexpr int kFrames = 20;
  double sum_m = 0.0;
  int seen = 0;
  for (std::uint32_t seed = 1; seed <= kFrames; ++seed) {
    LandmarkDetector detector{LandmarkParams{}};
    ASSERT_EQ(detector.detect(far_view(room, seed)), DetectResult::kOk);
    for (const Landmark& landmark : detector.landmarks()) {
      const double x_m = landmark.range_m * std::cos(landmark.bearing_rad);
      const double y_m = landmark.range_m * std::sin(landmark.bearing_rad);
      if (!is_occluding(landmark) || std::hypot(x_m - 2.0, y_m - end_m.y()) > 0.15) continue;
      sum_m += landmark.range_m - end_m.norm();
      ++seen;
    }
  }
  ASSERT_GE(seen, kFrames / 2);
  const double quantum_m = 2.0 * 2.0 / 351.0;
  EXPECT_LT(std::abs(sum_m / seen), 0.35 * quantum_m);
}

TEST(LandmarkDetectorRange, AutomaticRangeLeavesTheBackgroundOut) {
  SyntheticRoom room = furnished_room();
  LandmarkParams params;
  params.range_is_automatic = true;
  LandmarkDetector automatic(params);
  LandmarkDetector fixed{LandmarkParams{}};
  const RgbdFrame frame = far_view(room, 1);
  ASSERT_EQ(automatic.detect(frame), DetectResult::kOk);
  ASSERT_EQ(fixed.detect(frame), DetectResult::kOk);
  EXPECT_EQ(fixed.range_max_m(), 3.81);
  EXPECT_LT(automatic.range_max_m(), 3.81);
  EXPECT_GT(automatic.range_max_m(), 0.6);
  for (const EdgePixel& edge : automatic.edges()) {
    EXPECT_LE(edge.near_steps * 0.001, automatic.range_max_m() + 0.002);
  }
}

}  // namespace
}  // namespace roomwise::landmark
