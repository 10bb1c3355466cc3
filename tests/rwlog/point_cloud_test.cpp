#include "logs/tools/point_cloud.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "logs/tools/point_files.h"

namespace roomwise {
namespace {

RgbdFrame made_frame() {
  RgbdFrame frame;
  frame.depth = {.width_px = 4, .height_px = 3, .unit_m = 0.001, .steps = {}};
  frame.depth.steps.assign(12, 2000);
  frame.depth_camera =
      frame.color_camera = {.fx_px = 2.0, .fy_px = 2.0, .cx_px = 1.0, .cy_px = 1.0};
  frame.color = {.width_px = 4, .height_px = 3, .rgb = {}};
  for (int i = 0; i < 36; ++i) frame.color.rgb.push_back(static_cast<std::uint8_t>(i));
  return frame;
}

TEST(PointsOf, StandWherePixelAndDepthSay) {
  const PointCloud cloud = points_of(made_frame(), 5.0);
  ASSERT_EQ(cloud.size(), 12U);
  EXPECT_EQ(cloud[0].p_m, Eigen::Vector3f(-1.0F, -1.0F, 2.0F));
  EXPECT_EQ(cloud[7].p_m, Eigen::Vector3f(2.0F, 0.0F, 2.0F));
  EXPECT_EQ(cloud[7].rgb, (std::array<std::uint8_t, 3>{21, 22, 23}));
}

TEST(PointsOf, LeavesOutWhatHasNoReadingOrIsTooFar) {
  RgbdFrame frame = made_frame();
  frame.depth.steps[0] = 0;
  frame.depth.steps[1] = 5001;
  EXPECT_EQ(points_of(frame, 5.0).size(), 10U);
}

TEST(PointsOf, OutsideTheColourImageIsGrey) {
  RgbdFrame frame = made_frame();
  frame.color_camera.cx_px = -100.0;
  EXPECT_EQ(points_of(frame, 5.0)[0].rgb, (std::array<std::uint8_t, 3>{128, 128, 128}));
}

PointCloud any_cloud() {
  PointCloud cloud;
  for (const auto& c : *rc::gen::container<std::vector<std::array<int, 3>>>(
           rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-5000, 5000)))) {
    cloud.push_back({Eigen::Vector3f(static_cast<float>(c[0]), static_cast<float>(c[1]),
                                     static_cast<float>(c[2])) *
                         0.01F,
                     {}});
  }
  return cloud;
}

RC_GTEST_PROP(VoxelGridLaws, LeavesAPointForEachCubeThatHoldsOne, ()) {
  const PointCloud cloud = any_cloud();
  VoxelGrid grid(0.5);
  grid.add(cloud, Eigen::Isometry3d::Identity());
  std::set<std::array<int, 3>> cubes;
  for (const ColoredPoint& point : cloud) {
    const Eigen::Vector3d cube = (point.p_m.cast<double>() / 0.5).array().floor();
    cubes.insert(
        {static_cast<int>(cube.x()), static_cast<int>(cube.y()), static_cast<int>(cube.z())});
  }
  RC_ASSERT(grid.thinned().size() == cubes.size());
}

RC_GTEST_PROP(VoxelGridLaws, DoesNotHeedTheOrderOfClouds, ()) {
  const PointCloud a = any_cloud();
  const PointCloud b = {{Eigen::Vector3f(200.0F, 0.0F, 0.0F), {9, 9, 9}}};
  VoxelGrid ab(0.1);
  VoxelGrid ba(0.1);
  ab.add(a, Eigen::Isometry3d::Identity());
  ab.add(b, Eigen::Isometry3d::Identity());
  ba.add(b, Eigen::Isometry3d::Identity());
  ba.add(a, Eigen::Isometry3d::Identity());
  RC_ASSERT(ab.thinned() == ba.thinned());
}

TEST(VoxelGrid, LeavesOutWhatIsBeyondReachOrNotFinite) {
  VoxelGrid grid(VoxelGrid::kSmallestVoxel_m);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  grid.add({{Eigen::Vector3f(1e30F, 0.0F, 0.0F), {}},
            {Eigen::Vector3f(0.0F, nan, 0.0F), {}},
            {Eigen::Vector3f(-999.9F, 999.9F, 0.0F), {}}},
           Eigen::Isometry3d::Identity());
  EXPECT_EQ(grid.thinned().size(), 1U);
  EXPECT_THROW(VoxelGrid(0.0), std::invalid_argument);
  EXPECT_THROW(VoxelGrid(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise
