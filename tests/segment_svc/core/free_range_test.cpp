#include "services/segment_svc/core/free_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/scenes.h"

namespace roomwise::segment {
namespace {

constexpr std::size_t kAhead = FreeRange::kBins / 2;
constexpr SyntheticCamera kRobot{.height_m = 0.35, .pitch_rad = 0.15};

SyntheticRoom room_with_wall(double x_m) {
  return {.boxes = {{.low_m = {x_m, -5.0, 0.0}, .high_m = {x_m + 0.1, 5.0, 2.5}}}};
}

Segmentation segmented(const RgbdFrame& frame) {
  Segmentation result;
  Segmenter(SegmentParams{}).segment(frame, result);
  return result;
}

TEST(FreeRange, EndsAtTheWallAlongEveryBearing) {
  const Segmentation result = segmented(render(room_with_wall(2.5), kRobot, Pose2{}, 1));
  for (std::size_t k = kAhead - 20; k <= kAhead + 20; ++k) {
    const double bearing_rad =
        FreeRange::first_bearing_rad() + static_cast<double>(k) * FreeRange::step_rad();
    EXPECT_NEAR(result.bearings[k].free_range_m, 2.5 / std::cos(bearing_rad), 0.16) << k;
    EXPECT_LE(result.bearings[k].free_range_m, 2.5 / std::cos(bearing_rad) + 0.01) << k;
  }
}

TEST(FreeRange, TellsWhereSomethingStandsThoughItHidesAllFloor) {
  const Segmentation result = segmented(render(room_with_wall(0.55), kRobot, Pose2{}, 1));
  for (std::size_t k = kAhead - 20; k <= kAhead + 20; ++k) {
    const double bearing_rad =
        FreeRange::first_bearing_rad() + static_cast<double>(k) * FreeRange::step_rad();
    EXPECT_EQ(result.bearings[k].free_range_m, 0.0);
    EXPECT_NEAR(result.bearings[k].obstacle_range_m, 0.55 / std::cos(bearing_rad), 0.05) << k;
  }
}

TEST(FreeRange, BearingIsPositiveToTheLeft) {
  SyntheticRoom room = room_with_wall(3.0);
  room.boxes.push_back({.low_m = {1.5, 0.3, 0.0}, .high_m = {1.8, 0.6, 0.4}});
  const Segmentation result = segmented(render(room, kRobot, Pose2{}, 1));
  EXPECT_NEAR(result.bearings[kAhead + 15].free_range_m, 1.55, 0.16);  // 15 degrees left
  EXPECT_GT(result.bearings[kAhead - 15].free_range_m, 2.7);
}

TEST(FreeRange, CameraBesideTheMiddleSeesTheSameFloor) {
  RgbdFrame frame = render(room_with_wall(2.5), kRobot, Pose2{}, 1);
  frame.T_robot_camera.translation().x() = 0.2;  // 20 cm before the wheels
  EXPECT_NEAR(segmented(frame).bearings[kAhead].free_range_m, 2.7, 0.16);
}

TEST(FreeRange, EndsWhereTheFloorIsNotSeen) {
  RgbdFrame frame = render(room_with_wall(4.0), kRobot, Pose2{}, 1);
  const double free_before_m = segmented(frame).bearings[kAhead].free_range_m;
  for (int v = 230; v < 340; ++v) {  // a dark patch or a mirror on the floor
    for (int u = 0; u < 640; ++u) {
      frame.depth.steps[static_cast<std::size_t>(v * 640 + u)] = 0;
    }
  }
  const Segmentation result = segmented(frame);
  EXPECT_GT(free_before_m, 3.0);
  EXPECT_LT(result.bearings[kAhead].free_range_m, 1.5);
  EXPECT_GT(result.bearings[kAhead].unknown_ratio, 0.15);
}

TEST(FreeRange, FloorBeyondAnUnseenStretchIsNotFree) {
  RgbdFrame frame = render(room_with_wall(4.0), kRobot, Pose2{}, 1);
  for (int v = 300; v < 480; ++v) {  // all floor nearer than about 1.4 m
    for (int u = 0; u < 640; ++u) {
      frame.depth.steps[static_cast<std::size_t>(v * 640 + u)] = 0;
    }
  }
  EXPECT_EQ(segmented(frame).bearings[kAhead].free_range_m, 0.0);
}

TEST(FreeRange, NothingSeenIsNothingFree) {
  RgbdFrame frame = render(room_with_wall(4.0), kRobot, Pose2{}, 1);
  std::fill(frame.depth.steps.begin(), frame.depth.steps.end(), std::uint16_t{0});
  for (const BearingBin& bin : segmented(frame).bearings) {
    EXPECT_EQ(bin.free_range_m, 0.0);
    EXPECT_EQ(bin.unknown_ratio, 1.0);
  }
}

TEST(FreeRange, WhatIsHigherThanTheRobotDoesNotStopIt) {
  SyntheticRoom room = room_with_wall(3.0);
  room.boxes.push_back({.low_m = {1.2, -1.0, 0.75}, .high_m = {1.8, 1.0, 0.80}});  // a table top
  EXPECT_GT(segmented(render(room, kRobot, Pose2{}, 1)).bearings[kAhead].free_range_m, 2.7);
}

TEST(Corridor, NearDistanceIsTheObstaclesNotTheFloors) {
  SyntheticRoom room = room_with_wall(3.0);
  room.boxes.push_back({.low_m = {1.4, -0.1, 0.0}, .high_m = {1.6, 0.1, 0.3}});
  const Segmentation result = segmented(render(room, kRobot, Pose2{}, 1));
  EXPECT_NEAR(result.corridor.near_m, 1.4, 0.05);
  EXPECT_LT(result.corridor.unknown_ratio, 0.05);
  EXPECT_GT(result.distances.mean_m, 1.5);  // the thesis's average never meant the obstacle
}

TEST(Corridor, WhatStandsBesideItIsNotInTheWay) {
  SyntheticRoom room = room_with_wall(3.0);
  room.boxes.push_back({.low_m = {1.4, 0.35, 0.0}, .high_m = {1.6, 0.6, 0.3}});
  EXPECT_NEAR(segmented(render(room, kRobot, Pose2{}, 1)).corridor.near_m, 3.0, 0.08);
}

TEST(Corridor, CountsUnknownPixelsWhereTheyWouldSeeTheFloor) {
  RgbdFrame frame = render(room_with_wall(4.0), kRobot, Pose2{}, 1);
  for (int v = 240; v < 480; ++v) {
    for (int u = 200; u < 440; ++u) {
      frame.depth.steps[static_cast<std::size_t>(v * 640 + u)] = 0;
    }
  }
  EXPECT_GT(segmented(frame).corridor.unknown_ratio, 0.5);
}

}  // namespace
}  // namespace roomwise::segment
