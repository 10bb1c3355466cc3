#include "services/segment_svc/core/fused_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/scenes.h"
#include "tests/segment_svc/support/taught.h"

namespace roomwise::segment {
namespace {

SegmentParams with_model(const char* model) {
  SegmentParams params;
  params.model = model;
  return params;
}

RgbdFrame furnished(std::uint32_t seed = 1) {
  return furnished_frame({.width_px = 320, .height_px = 240, .height_m = 0.5, .pitch_rad = 0.3},
                         seed);
}

/// Labels of the last of thirty frames like this one.
std::vector<std::uint8_t> labels_of(const RgbdFrame& frame, const char* model,
                                    const ColorModel* taught = nullptr) {
  Segmenter segmenter(with_model(model));
  if (taught != nullptr) segmenter.learn(*taught);
  Segmentation result;
  for (int i = 0; i < 30; ++i) segmenter.segment(frame, result);
  return result.labels;
}

TEST(Fused, NeverMakesAnythingAccessible) {
  const RgbdFrame frame = furnished();
  const auto geometry = labels_of(frame, "geometry");
  // Everything looks like floor, says the teacher.
  const ColorModel taught = {.grey = {{{0.0, 1.0}, {1.0, 1.0}, {125.0, 99.0}}},
                             .mixtures = {around(0, 0, 0), around(1, 1, 1), around(128, 128, 128)}};
  const auto fused = labels_of(frame, "fused", &taught);
  for (std::size_t i = 0; i < fused.size(); ++i) {
    ASSERT_TRUE(fused[i] != kAccessible || geometry[i] == kAccessible) << i;
  }
}

TEST(Fused, LeavesDropOffsAlone) {
  const RgbdFrame frame = furnished();
  Segmentation geometry;
  Segmenter segmenter(with_model("geometry"));
  segmenter.segment(frame, geometry);
  std::vector<std::uint8_t> labels(geometry.labels.size(), kDropOff);
  CameraView view;
  view.prepare(frame, SegmentParams{}.baseline_m);
  FusedLabels fused;
  fused.correct(frame, view, geometry.floor.plane, labels);
  EXPECT_EQ(count(labels, kDropOff), 320 * 240);
}

TEST(Fused, DarkOrForeignColorChangesNothing) {
  RgbdFrame none = furnished();
  none.color = {};
  const auto expected = labels_of(none, "fused");

  RgbdFrame dark = furnished();
  for (std::uint8_t& level : dark.color.rgb) level = static_cast<std::uint8_t>(level / 20);
  EXPECT_EQ(labels_of(dark, "fused"), expected);

  RgbdFrame unregistered = furnished();
  unregistered.depth_registered = false;
  EXPECT_EQ(labels_of(unregistered, "fused"), expected);
}

/// Left half as `left`, the rest as `right`.
void paint_halves(RgbdFrame& frame, std::array<std::uint8_t, 3> left,
                  std::array<std::uint8_t, 3> right) {
  const int width = frame.color.width_px;
  for (std::size_t i = 0; i < frame.color.rgb.size(); ++i) {
    const int u = static_cast<int>(i / 3) % width;
    frame.color.rgb[i] = (u < width / 2 ? left : right)[i % 3];
  }
}

TEST(Fused, BlindSpotsInAColorThatOnlyWallsHaveBecomeWall) {
  // A wall across the view, a low box before it; some of the wall is not read.
  SyntheticRoom room;
  room.boxes = {{.low_m = {2.0, -3.0, 0.0}, .high_m = {2.1, 3.0, 2.5}, .rgb = {200, 200, 190}},
                {.low_m = {1.2, -0.4, 0.0}, .high_m = {1.4, 0.4, 0.4}, .rgb = {60, 60, 160}}};
  RgbdFrame frame = render(room, {.width_px = 320, .height_px = 240, .height_m = 0.5}, {}, 1);
  const auto hole = [](std::size_t i) { return i / 320 < 60 && i % 320 >= 100 && i % 320 < 130; };
  for (std::size_t i = 0; i < frame.depth.steps.size(); ++i) {
    if (hole(i)) frame.depth.steps[i] = 0;
  }
  const auto geometry = labels_of(frame, "geometry");
  const auto fused = labels_of(frame, "fused");
  int walls = 0;
  for (std::size_t i = 0; i < fused.size(); ++i) {
    if (!hole(i)) continue;
    ASSERT_EQ(geometry[i], kUnknown);
    ASSERT_NE(fused[i], kAccessible);
    walls += fused[i] == kWall ? 1 : 0;
  }
  EXPECT_GT(walls, 30 * 60 * 3 / 4);
}

TEST(Fused, TeachingMovesWhatStandsUpBetweenObstacleAndWall) {
  RgbdFrame frame = furnished();
  paint_halves(frame, {60, 60, 160}, {200, 200, 190});
  const auto grey = [](int level) {
    return GreyGaussian{.mean_levels = level + 0.0, .sigma_levels = 70.0};
  };
  const ColorModel blue_is_wall = {
      .grey = {grey(198), grey(71), grey(130)},
      .mixtures = {around(200, 200, 190), around(60, 60, 160), around(150, 110, 70)}};
  const ColorModel blue_is_obstacle = {
      .grey = {grey(71), grey(198), grey(130)},
      .mixtures = {around(60, 60, 160), around(200, 200, 190), around(150, 110, 70)}};
  const auto as_wall = labels_of(frame, "fused", &blue_is_wall);
  const auto as_obstacle = labels_of(frame, "fused", &blue_is_obstacle);
  int moved = 0;
  for (std::size_t i = 0; i < as_wall.size(); ++i) {
    if (i % 320 >= 160) continue;
    moved += as_wall[i] == kWall && as_obstacle[i] == kObstacle ? 1 : 0;
    EXPECT_FALSE(as_wall[i] == kObstacle && as_obstacle[i] == kWall);
  }
  EXPECT_GT(moved, 1000);
}

}  // namespace
}  // namespace roomwise::segment
