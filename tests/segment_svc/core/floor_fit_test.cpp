#include "services/segment_svc/core/floor_fit.h"

#include <gtest/gtest.h>

#include <numbers>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/scenes.h"

namespace roomwise::segment {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

Segmentation segment(const RgbdFrame& frame) {
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  segmenter.segment(frame, result);
  return result;
}

FloorEstimate fit_once(FloorFit& fit, const RgbdFrame& frame) {
  CameraView view;
  view.prepare(frame, 0.075);
  return fit.fit(frame, view);
}

SyntheticBox wall_at(double x_m) {
  return {.low_m = {x_m, -5.0, -1.0}, .high_m = {x_m + 0.1, 5.0, 4.0}, .rgb = {200, 200, 190}};
}

class UnknownTilt : public testing::TestWithParam<int> {};

TEST_P(UnknownTilt, CostsNothing) {
  const double tilt_rad = GetParam() * kDegree_rad;
  for (const double height_m : {0.25, 0.4, 0.8, 1.4}) {
    for (const auto& [roll, pitch] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}, {0.7, 0.7}}) {
      RgbdFrame frame =
          furnished_frame({.height_m = height_m, .pitch_rad = height_m > 0.5 ? 0.35 : 0.1});
      mistake_mounting(frame, roll * tilt_rad, pitch * tilt_rad);
      const Segmentation result = segment(frame);
      EXPECT_TRUE(result.floor.trusted) << height_m << " m";
      EXPECT_GE(floor_iou(frame, result.labels), 0.95)
          << height_m << " m, roll " << roll << " pitch " << pitch;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, UnknownTilt, testing::Range(0, 6));

TEST(FloorFit, FindsTheHeightWhateverTheMountingSays) {
  for (const double height_m : {0.2, 0.6, 1.0, 1.5, 1.8}) {
    RgbdFrame frame = furnished_frame({.height_m = height_m, .pitch_rad = 0.4});
    for (const double claimed_m : {0.3, 1.2, 1.9}) {
      frame.T_robot_camera.translation().z() = claimed_m;
      FloorFit fit(SegmentParams{});
      const FloorEstimate floor = fit_once(fit, frame);
      ASSERT_TRUE(floor.trusted) << height_m << " m, claimed " << claimed_m;
      EXPECT_NEAR(floor.plane.height_m, height_m, 0.01);
    }
  }
}

TEST(FloorFit, PitchIsPositiveDownAndRollPositiveRight) {
  FloorFit fit(SegmentParams{});
  const FloorEstimate floor = fit_once(fit, tilted_floor_frame(0.5, 0.05, 0.30, 3.0));
  ASSERT_TRUE(floor.trusted);
  EXPECT_NEAR(floor.plane.pitch_rad(), 0.30, 0.01);
  EXPECT_NEAR(floor.plane.roll_rad(), 0.05, 0.01);  // turned about x forward: right side down
}

TEST(FloorFit, WallThatFillsTheViewNeverBecomesTheFloor) {
  for (const double wall_m : {0.7, 1.2, 2.0}) {
    for (const double tilt_rad : {-0.15, 0.0, 0.15}) {
      RgbdFrame frame =
          render({.boxes = {wall_at(wall_m)}, .has_floor = false}, {.height_m = 1.0}, Pose2{}, 3);
      mistake_mounting(frame, 0.0, tilt_rad);
      const Segmentation result = segment(frame);
      EXPECT_FALSE(result.floor.trusted) << wall_m << " m, " << tilt_rad;
      EXPECT_LT(count(result.labels, kAccessible), 0.12 * 640 * 480) << "only the mounting's slab";
    }
  }
}

TEST(FloorFit, CornerOfTwoWallsNeverBecomesTheFloor) {
  const SyntheticRoom room{
      .boxes = {wall_at(1.8), {.low_m = {-1.0, 0.5, -1.0}, .high_m = {5.0, 0.6, 4.0}}},
      .has_floor = false};
  EXPECT_FALSE(segment(render(room, {.height_m = 1.0}, Pose2{}, 4)).floor.trusted);
}

TEST(FloorFit, KeepsTheFloorWhileAWallFillsTheView) {
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  segmenter.segment(furnished_frame({.height_m = 1.0, .pitch_rad = 0.1}), result);
  ASSERT_TRUE(result.floor.trusted);
  segmenter.segment(
      render({.boxes = {wall_at(1.0)}}, {.height_m = 1.0, .pitch_rad = 0.1}, Pose2{}, 5), result);
  EXPECT_FALSE(result.floor.trusted);
  EXPECT_NEAR(result.floor.plane.height_m, 1.0, 0.02);
  EXPECT_EQ(count(result.labels, kAccessible), 0);
}

TEST(FloorFit, TableTopIsNotTheFloorWhereFloorIsSeenBesideIt) {
  const SyntheticRoom room{
      .boxes = {{.low_m = {0.8, -0.8, 0.70}, .high_m = {2.2, 0.8, 0.75}}, wall_at(4.0)}};
  RgbdFrame frame = render(room, {.height_m = 1.4, .pitch_rad = 0.5}, Pose2{}, 6);
  frame.T_robot_camera.translation().z() = 0.9;  // nearer to the table's height than the floor's
  const Segmentation result = segment(frame);
  ASSERT_TRUE(result.floor.trusted);
  EXPECT_NEAR(result.floor.plane.height_m, 1.4, 0.02);
  EXPECT_GE(floor_iou(frame, result.labels), 0.95);
}

TEST(FloorFit, TableTakenForTheFloorGivesWayOnceTheFloorIsSeen) {
  const SyntheticBox table{.low_m = {0.3, -3.0, 0.70}, .high_m = {2.0, 3.0, 0.75}};
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  RgbdFrame frame =
      render({.boxes = {table, wall_at(2.0)}}, {.height_m = 1.4, .pitch_rad = 0.6}, Pose2{}, 7);
  frame.T_robot_camera.translation().z() = 1.0;
  segmenter.segment(frame, result);
  ASSERT_NEAR(result.floor.plane.height_m, 0.65, 0.02) << "nothing but a table in view";
  frame = render({.boxes = {table}}, {.height_m = 1.4, .pitch_rad = 0.3}, Pose2{}, 7);
  frame.T_robot_camera.translation().z() = 1.0;
  segmenter.segment(frame, result);
  EXPECT_NEAR(result.floor.plane.height_m, 1.4, 0.02);
}

TEST(FloorFit, FollowsACameraThatIsCarried) {
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  for (int i = 0; i < 20; ++i) {
    const double height_m = 1.3 - 0.02 * i;
    RgbdFrame frame = furnished_frame({.height_m = height_m, .pitch_rad = 0.3 + 0.01 * i},
                                      static_cast<unsigned>(i));
    frame.T_robot_camera.translation().z() = height_m - 0.2;  // knows how it moves, not how high
    mistake_mounting(frame, 0.02, -0.03);
    segmenter.segment(frame, result);
    ASSERT_TRUE(result.floor.trusted) << i;
    EXPECT_NEAR(result.floor.plane.height_m, height_m, 0.01) << i;
  }
}

TEST(FloorFit, EmptyFrameKeepsTheMountingsFloor) {
  RgbdFrame frame = furnished_frame({.height_m = 0.7, .pitch_rad = 0.2});
  std::fill(frame.depth.steps.begin(), frame.depth.steps.end(), std::uint16_t{0});
  FloorFit fit(SegmentParams{});
  const FloorEstimate floor = fit_once(fit, frame);
  EXPECT_FALSE(floor.trusted);
  EXPECT_EQ(floor.inliers, 0);
  EXPECT_NEAR(floor.plane.height_m, 0.7, 1e-9);
  EXPECT_NEAR(floor.plane.pitch_rad(), 0.2, 1e-9);
}

TEST(FloorPlane, CarriedForthAndBackIsTheSame) {
  const FloorPlane floor{.normal = Eigen::Vector3d(0.1, -0.9, -0.3).normalized(), .height_m = 0.8};
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  before.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  Eigen::Isometry3d now = before;
  now.rotate(Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX()));
  now.pretranslate(Eigen::Vector3d(0.1, 0.2, 0.3));
  const FloorPlane back = carried_floor(carried_floor(floor, before, now), now, before);
  EXPECT_TRUE(back.normal.isApprox(floor.normal, 1e-12));
  EXPECT_NEAR(back.height_m, floor.height_m, 1e-12);
}

}  // namespace
}  // namespace roomwise::segment
