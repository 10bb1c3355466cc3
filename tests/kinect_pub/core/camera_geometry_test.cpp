#include "services/kinect_pub/core/camera_geometry.h"

#include <gtest/gtest.h>

#include <numbers>

namespace roomwise::kinect {
namespace {

TEST(CameraGeometry, FieldsOfViewReachTheImageEdges) {
  const PinholeCamera camera = camera_from_fields_of_view(640, 480, 1.0144686, 0.7898090);
  EXPECT_NEAR(camera.fx_px, 576.0, 1.0);
  EXPECT_NEAR(std::atan(camera.cx_px / camera.fx_px), 1.0144686 / 2.0, 1e-12);
  EXPECT_NEAR(std::atan(camera.cy_px / camera.fy_px), 0.7898090 / 2.0, 1e-12);
}

TEST(CameraGeometry, HalfTheImageHasHalfTheFocalLength) {
  const PinholeCamera large = camera_from_fields_of_view(640, 480, 1.0, 0.8);
  const PinholeCamera small = camera_from_fields_of_view(320, 240, 1.0, 0.8);
  EXPECT_NEAR(large.fx_px, 2.0 * small.fx_px, 1e-9);
  EXPECT_NEAR(large.fy_px, 2.0 * small.fy_px, 1e-9);
}

/// Where the camera's forward axis points on the robot.
Eigen::Vector3d forward(const KinectParams& params) {
  return camera_on_robot(params).linear() * Eigen::Vector3d::UnitZ();
}

TEST(CameraGeometry, LevelCameraLooksForwardWithRightToTheRight) {
  const KinectParams params;
  EXPECT_TRUE(forward(params).isApprox(Eigen::Vector3d::UnitX()));
  const Eigen::Isometry3d T = camera_on_robot(params);
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY()));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ()));
}

TEST(CameraGeometry, PitchLooksDownYawLooksLeftRollLeansRight) {
  KinectParams pitched;
  pitched.camera_pitch_rad = 0.2;
  EXPECT_TRUE(forward(pitched).isApprox(Eigen::Vector3d(std::cos(0.2), 0.0, -std::sin(0.2))));
  KinectParams turned;
  turned.camera_yaw_rad = 0.3;
  EXPECT_TRUE(forward(turned).isApprox(Eigen::Vector3d(std::cos(0.3), std::sin(0.3), 0.0)));
  KinectParams leaning;
  leaning.camera_roll_rad = 0.1;
  const Eigen::Vector3d up = camera_on_robot(leaning).linear() * Eigen::Vector3d(0.0, -1.0, 0.0);
  EXPECT_TRUE(up.isApprox(Eigen::Vector3d(0.0, -std::sin(0.1), std::cos(0.1))));
}

TEST(CameraGeometry, PointAheadOfAPitchedCameraLiesWhereTrigonometryPutsIt) {
  KinectParams params;
  params.camera_x_m = 0.1;
  params.camera_height_m = 0.4;
  params.camera_pitch_rad = std::numbers::pi / 6.0;
  const double to_floor_m = 0.4 / std::sin(params.camera_pitch_rad);
  const Eigen::Vector3d p_robot_m = camera_on_robot(params) * Eigen::Vector3d(0, 0, to_floor_m);
  EXPECT_NEAR(p_robot_m.z(), 0.0, 1e-12);
  EXPECT_NEAR(p_robot_m.x(), 0.1 + 0.4 / std::tan(params.camera_pitch_rad), 1e-12);
}

}  // namespace
}  // namespace roomwise::kinect
