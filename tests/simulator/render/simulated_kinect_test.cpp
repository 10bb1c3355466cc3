#include "services/simulator/render/simulated_kinect.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/simulator/core/kinect/true_labels.h"
#include "tests/simulator/support/disparity_statistics.h"
#include "tests/simulator/support/plain_scene.h"
#include "tests/simulator/support/simulated_disparity.h"

namespace roomwise::simulator {
namespace {

// Real Kinects (v1), by the same measure: floor of 24 frames of a kitchen (registered), all flat
// surfaces of those frames, and all of 15 frames of a resting camera.
constexpr double kRealSigma_quanta = 0.545;                       // 0.546, 0.559, 0.530
constexpr double kRealSecondDifference_quanta = 1.43;             // 1.389, 1.469, 1.433
constexpr double kRealFrameDifference_quanta = 0.62;              // 0.617, the resting camera
constexpr double kRealAcross[] = {1.00, 0.60, 0.45, 0.31, 0.21};  // shifts of 0 to 4 px
constexpr double kRealDown[] = {1.00, 0.59, 0.43, 0.29, 0.17};

void expect_real_scatter(const PlaneScatter& scatter) {
  EXPECT_GT(scatter.windows, 200);
  EXPECT_NEAR(scatter.sigma_quanta, kRealSigma_quanta, 0.2 * kRealSigma_quanta);
  EXPECT_NEAR(scatter.second_difference_quanta, kRealSecondDifference_quanta,
              0.2 * kRealSecondDifference_quanta);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(scatter.across[i], kRealAcross[i], 0.15) << i;
    EXPECT_NEAR(scatter.down[i], kRealDown[i], 0.15) << i;
  }
}

TEST(SimulatedKinect, FloorScattersAsOnRealKinects) {
  expect_real_scatter(plane_scatter(disparities_of_floor()));
}

TEST(SimulatedKinect, WallScattersAsOnRealKinects) {
  const std::vector<DisparityImage> images = disparities_of_wall();
  expect_real_scatter(plane_scatter(images));
  EXPECT_NEAR(frame_difference_quanta(images), kRealFrameDifference_quanta,
              0.2 * kRealFrameDifference_quanta);
}

PlainScene post_before_wall() {
  PlainScene plain;
  plain.put_wall(3.0).put(box({1.0, -0.2, -5.0}, {1.05, 0.2, 5.0}));
  return plain;
}

/// Holes of row 200 to the left and right of the post in front of the wall.
std::pair<int, int> holes_beside_post(bool registered) {
  PlainScene plain = post_before_wall();
  SimulatedKinect kinect(plain.scene(), {.ragged_px = 0.0, .depth_dropout_ratio = 0.0}, {}, 1);
  RgbdFrame frame;
  kinect.capture(camera_pose(1.0), 0.0, 0, {.registered = registered}, frame);
  int left = 0, right = 0;
  for (int u = 0; u < 632; ++u) (u < 320 ? left : right) += frame.depth.at(u, 200) == 0;
  return {left, right};
}

TEST(SimulatedKinect, ShadowIsThatOfAProjectorBesideTheCameraTheImageIsFrom) {
  const double disparity_per_m = 1.0 / 1.0 - 1.0 / 3.0;
  const auto [own_left, own_right] = holes_beside_post(false);
  EXPECT_NEAR(own_left, 585.0 * 0.075 * disparity_per_m, 1.0);
  EXPECT_EQ(own_right, 0);
  const auto [registered_left, registered_right] = holes_beside_post(true);
  EXPECT_NEAR(registered_left, 525.0 * 0.050 * disparity_per_m, 1.0);
  EXPECT_EQ(registered_right, 0);
}

TEST(SimulatedKinect, SaysWhichCamerasTheImagesAreFrom) {
  PlainScene plain;
  plain.put_wall(2.0);
  SimulatedKinect kinect(plain.scene(), {}, {}, 1);
  RgbdFrame frame;
  kinect.capture(camera_pose(1.0), 0.0, 0, {}, frame);
  EXPECT_TRUE(frame.depth_registered);
  EXPECT_EQ(frame.depth_camera.fx_px, 525.0);
  EXPECT_EQ(frame.color_camera.fx_px, 525.0);
  EXPECT_EQ(frame.depth.width_px, 640);
  EXPECT_EQ(frame.color.height_px, 480);
  kinect.capture(camera_pose(1.0), 0.0, 1, {.width_px = 320, .height_px = 240, .registered = false},
                 frame);
  EXPECT_FALSE(frame.depth_registered);
  EXPECT_EQ(frame.depth_camera.fx_px, 292.5);
  EXPECT_EQ(frame.depth_camera.cx_px, 160.0);
  EXPECT_EQ(frame.color_camera.fx_px, 262.5);
  EXPECT_EQ(frame.depth.size(), 320U * 240U);
  EXPECT_EQ(frame.color.rgb.size(), 3U * 320U * 240U);
}

TEST(SimulatedKinect, AMirrorShowsNothingNearerThanItsWorld) {
  PlainScene plain;
  plain.put(box({-1.5, -30.0, -30.0}, {-1.0, 30.0, 30.0}));
  plain.made_of({.name = "mirror", .mirror = 0.95F}).put(box({1.0, -9.0, -9.0}, {1.1, 9.0, 9.0}));
  SimulatedKinect kinect(plain.scene(), {}, {}, 1);
  RgbdFrame frame;
  kinect.capture(camera_pose(1.0), 0.0, 0, {}, frame);
  int readings = 0;
  for (const std::uint16_t mm : frame.depth.steps) {
    if (mm == 0) continue;
    ++readings;
    ASSERT_GT(mm, 2850);  // the wall's mirror image is 3.0 m away, a quantum there 26 mm
  }
  EXPECT_GT(readings, 200000);
}

TEST(SimulatedKinect, LabelsOfAFrameAreUnknownWhereItHasNoDepth) {
  PlainScene plain;
  plain.put_floor().put(box({1.2, -0.2, 0.0}, {1.5, 0.2, 0.5}));
  SimulatedKinect kinect(plain.scene(), {}, {}, 1);
  RgbdFrame frame;
  kinect.capture(camera_pose(0.4, 0.2), 0.0, 0, {}, frame);
  std::vector<std::uint8_t> labels;
  true_labels(kinect.view(), frame.depth.steps, labels);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_there = kinect.view().surface_class[i] != kNoSurface;
    ASSERT_EQ(labels[i] == 255, frame.depth.steps[i] == 0 || !is_there);
  }
  EXPECT_GT(std::count(labels.begin(), labels.end(), 200), 50000);
  EXPECT_GT(std::count(labels.begin(), labels.end(), 0), 10000);
}

TEST(SimulatedKinect, TheSameSeedGivesTheSameBytes) {
  PlainScene plain = post_before_wall();
  SimulatedKinect kinect(plain.scene(), {}, {}, 7), twin(plain.scene(), {}, {}, 7);
  SimulatedKinect stranger(plain.scene(), {}, {}, 8);
  RgbdFrame frame, again, strange;
  for (int i = 0; i < 3; ++i) {
    kinect.capture(camera_pose(1.0, 0.01 * i), 0.03 * i, i, {}, frame);
    twin.capture(camera_pose(1.0, 0.01 * i), 0.03 * i, i, {}, again);
    stranger.capture(camera_pose(1.0, 0.01 * i), 0.03 * i, i, {}, strange);
    EXPECT_EQ(frame.depth.steps, again.depth.steps);
    EXPECT_EQ(frame.color.rgb, again.color.rgb);
    EXPECT_NE(frame.depth.steps, strange.depth.steps);
    EXPECT_NE(frame.color.rgb, strange.color.rgb);
  }
}

TEST(SimulatedKinect, QuantaAreThoseOfTheDepthImage) {
  PlainScene plain = post_before_wall();
  SimulatedKinect kinect(plain.scene(), {}, {}, 7);
  RgbdFrame frame;
  kinect.capture(camera_pose(1.0), 0.0, 0, {}, frame);
  ASSERT_EQ(kinect.quanta().size(), frame.depth.size());
  for (std::size_t i = 0; i < frame.depth.size(); i += 97) {
    const int quanta = kinect.quanta()[i];
    EXPECT_EQ(frame.depth.steps[i], quanta == 0 ? 0 : std::lround(351000.0 / quanta));
  }
}

}  // namespace
}  // namespace roomwise::simulator
