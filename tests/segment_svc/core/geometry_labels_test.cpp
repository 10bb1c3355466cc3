#include "services/segment_svc/core/geometry_labels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/scenes.h"

namespace roomwise::segment {
namespace {

constexpr SyntheticCamera kSmall{
    .width_px = 160, .height_px = 120, .height_m = 0.5, .pitch_rad = 0.3};

std::vector<std::uint8_t> label(const RgbdFrame& frame, const FloorPlane& floor) {
  CameraView view;
  view.prepare(frame, 0.075);
  GeometryLabels geometry(SegmentParams{});
  std::vector<std::uint8_t> labels;
  geometry.label(frame, view, floor, labels);
  return labels;
}

std::vector<std::uint8_t> label(const RgbdFrame& frame) {
  return label(frame, mounted_floor(frame.T_robot_camera));
}

bool stands(std::uint8_t l) { return l == kObstacle || l == kWall; }

const RgbdFrame& small_frame() {
  static const RgbdFrame frame = furnished_frame(kSmall);
  return frame;
}

RC_GTEST_PROP(GeometryLabels, AddedPointChangesNoLabelButOfFeet, (std::uint16_t step)) {
  RgbdFrame frame = small_frame();
  const auto before = label(frame);
  const auto pixel = *rc::gen::inRange<std::size_t>(0, before.size());
  frame.depth.steps[pixel] = step;
  const auto after = label(frame);
  int changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    // One point more or less may tell a wall from an obstacle, and where a foot ends on the floor.
    const bool may_be_foot = before[i] != kUnknown && before[i] != kDropOff &&
                             after[i] != kUnknown && after[i] != kDropOff;
    changed += after[i] != before[i] && !(stands(after[i]) && stands(before[i])) ? 1 : 0;
    RC_ASSERT(i == pixel || after[i] == before[i] || may_be_foot);
  }
  RC_ASSERT(changed <= 40);
}

RC_GTEST_PROP(GeometryLabels, FarPointChangesNoOtherLabelAtAll, ()) {
  RgbdFrame frame = small_frame();
  const auto pixel = *rc::gen::inRange<std::size_t>(0, frame.depth.steps.size());
  frame.depth.steps[pixel] = 0;
  auto expected = label(frame);
  frame.depth.steps[pixel] = 9000;  // beyond what is believed
  RC_ASSERT(label(frame) == expected);
}

RC_GTEST_PROP(GeometryLabels, DependOnThePlaceNotOnTheOrderOfPixels, ()) {
  // Mirrored left to right, a level scene's labels are mirrored; the camera's centre is the
  // image's.
  RgbdFrame frame = small_frame();
  const auto width = static_cast<std::ptrdiff_t>(frame.depth.width_px);
  auto expected = label(frame);
  for (auto row = frame.depth.steps.begin(); row != frame.depth.steps.end(); row += width) {
    std::reverse(row, row + width);
  }
  for (auto row = expected.begin(); row != expected.end(); row += width) {
    std::reverse(row, row + width);
  }
  const auto mirrored = label(frame);
  for (std::size_t i = 0; i < mirrored.size(); ++i) {
    RC_ASSERT(mirrored[i] == expected[i] || (stands(mirrored[i]) && stands(expected[i])));
  }
}

RC_GTEST_PROP(GeometryLabels, RaisedOffTheFloorNeverBecomesFloor, ()) {
  // Nearer along its ray means higher: obstacle, then floor, then unknown, then drop-off.
  const auto order = [](std::uint8_t l) {
    return stands(l) ? 0 : l == kAccessible ? 1 : l == kUnknown ? 2 : 3;
  };
  RgbdFrame frame = small_frame();
  const auto u = *rc::gen::inRange(0, frame.depth.width_px);
  const auto v = *rc::gen::inRange(70, frame.depth.height_px);  // rays that go down
  const auto pixel = static_cast<std::size_t>(v * frame.depth.width_px + u);
  int last = 0;
  for (std::uint16_t step = 500; step < 6000; step = static_cast<std::uint16_t>(step + 50)) {
    frame.depth.steps[pixel] = step;
    const int now = order(label(frame)[pixel]);
    RC_ASSERT(now >= last);
    last = now;
  }
}

TEST(GeometryLabels, PixelsWithoutReadingAreUnknown) {
  RgbdFrame frame = small_frame();
  for (std::size_t i = 0; i < frame.depth.steps.size(); i += 7) frame.depth.steps[i] = 0;
  const auto labels = label(frame);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (frame.depth.steps[i] == 0) {
      ASSERT_EQ(labels[i], kUnknown);
    }
  }
  EXPECT_GT(count(labels, kUnknown), 0);
}

TEST(GeometryLabels, ColorChangesNothing) {
  RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  Segmentation bright;
  Segmentation dark;
  SegmentParams params;
  params.model = "geometry";
  Segmenter(params).segment(frame, bright);
  for (std::uint8_t& level : frame.color.rgb) level = static_cast<std::uint8_t>(level / 20);
  Segmenter(params).segment(frame, dark);
  EXPECT_EQ(bright.labels, dark.labels);
}

TEST(GeometryLabels, TellWallsAndWhatStandsFromFloor) {
  const RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.1});
  const auto labels = label(frame);
  int wall = 0;
  int wall_right = 0;
  int box = 0;
  int box_stands = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kUnknown) continue;
    const std::uint8_t red = frame.color.rgb[3 * i];
    wall += red >= 190 ? 1 : 0;
    wall_right += red >= 190 && labels[i] == kWall ? 1 : 0;
    box += red == 60 ? 1 : 0;
    box_stands += red == 60 && stands(labels[i]) ? 1 : 0;
  }
  EXPECT_GT(wall_right, 0.9 * wall);
  EXPECT_GE(box, 1000);
  EXPECT_GT(box_stands, 0.9 * box);
}

TEST(GeometryLabels, LowBoxesAreObstaclesNotWalls) {
  const SyntheticRoom room{.boxes = {{.low_m = {1.5, -0.6, 0.0}, .high_m = {2.0, 0.6, 0.45}}}};
  const auto labels = label(render(room, {.height_m = 0.5, .pitch_rad = 0.2}, Pose2{}, 1));
  EXPECT_EQ(count(labels, kWall), 0);
  EXPECT_GT(count(labels, kObstacle), 5000);
}

TEST(GeometryLabels, SixCentimetresOnTheFloorAreFoundAtOneAndAHalfMetres) {
  const SyntheticRoom room{.boxes = {{.low_m = {1.5, -0.1, 0.0}, .high_m = {1.7, 0.1, 0.06}}}};
  const RgbdFrame frame = render(room, {.height_m = 0.4, .pitch_rad = 0.2}, Pose2{}, 1);
  Segmentation result;
  Segmenter(SegmentParams{}).segment(frame, result);
  int found = 0;
  int there = 0;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (frame.color.rgb[3 * i] != 128) continue;
    ++there;
    found += stands(result.labels[i]) ? 1 : 0;
  }
  EXPECT_GT(there, 500);
  EXPECT_GT(found, 0.3 * there);
}

TEST(GeometryLabels, StairsDownAreADropOff) {
  SyntheticRoom room;
  room.has_floor = false;  // a landing, then four steps down from 1.2 m on
  room.boxes.push_back({.low_m = {-2, -3, -0.1}, .high_m = {1.2, 3, 0.0}, .rgb = kFloor_rgb});
  for (int i = 0; i < 8; ++i) {
    room.boxes.push_back({.low_m = {1.2 + 0.28 * i, -3, -3.0},
                          .high_m = {1.48 + 0.28 * i, 3, -0.17 * (i + 1)},
                          .rgb = {90, 90, 90}});
  }
  for (const double height_m : {0.3, 0.5, 1.0}) {
    const RgbdFrame frame =
        render(room, {.height_m = height_m, .pitch_rad = height_m > 0.8 ? 0.6 : 0.35}, Pose2{}, 1);
    Segmentation result;
    Segmenter(SegmentParams{}).segment(frame, result);
    EXPECT_TRUE(result.floor.trusted);
    EXPECT_NEAR(result.floor.plane.height_m, height_m, 0.02);
    // From low down the line of sight over the edge passes above the steps and meets nothing: then
    // they are unknown, and the free range must end at the edge all the same.
    if (height_m > 0.8) {
      EXPECT_GT(count(result.labels, kDropOff), 2000) << height_m;
    }
    const BearingBin& ahead = result.bearings[FreeRange::kBins / 2];
    EXPECT_LE(ahead.free_range_m, 1.25) << height_m;
    EXPECT_GE(ahead.free_range_m, 1.0) << height_m;
  }
}

}  // namespace
}  // namespace roomwise::segment
