#include "logs/tools/camera_pose.h"

#include <gtest/gtest.h>

#include "tests/rwlog/poses.h"

namespace roomwise {
namespace {

Eigen::Isometry3d on_floor(const Pose2& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << pose.x_m, pose.y_m, 0.0;
  T.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

RC_GTEST_PROP(CameraPose, ALevelCameraIsAboveTheRobotThatCarriesIt, ()) {
  const Pose2 robot = *any_pose();
  const Eigen::Isometry3d T_world_camera = on_floor(robot) * level_mounting(0.7);
  const Pose2 found = robot_below(T_world_camera);
  RC_ASSERT((found.position_m() - robot.position_m()).norm() < 1e-9);
  RC_ASSERT(std::abs(wrap_angle(found.heading_rad - robot.heading_rad)) < 1e-9);
  RC_ASSERT(mounting_of(T_world_camera).isApprox(level_mounting(0.7), 1e-9));
}

RC_GTEST_PROP(CameraPose, RobotAndMountingMakeUpTheCameraPose, ()) {
  Eigen::Isometry3d T_world_camera = on_floor(*any_pose()) * level_mounting(1.1);
  T_world_camera.rotate(Eigen::AngleAxisd(*number_between(-1.5, 1.5), Eigen::Vector3d::UnitX()));
  T_world_camera.rotate(Eigen::AngleAxisd(*number_between(-3.0, 3.0), Eigen::Vector3d::UnitZ()));
  const Eigen::Isometry3d again =
      on_floor(robot_below(T_world_camera)) * mounting_of(T_world_camera);
  RC_ASSERT(again.isApprox(T_world_camera, 1e-9));
}

TEST(CameraPose, StraightDownTheImagesUpIsForward) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << 1, 0, 0,  // right is world x
      0, -1, 0,                        // image down is -y
      0, 0, -1;                        // looks down
  EXPECT_NEAR(robot_below(T_world_camera).heading_rad, std::numbers::pi / 2, 1e-12);
}

RC_GTEST_PROP(CameraPose, LevelRotationTurnsDownToMinusZ, ()) {
  const Eigen::Vector3d down(*number_between(-1, 1), *number_between(-1, 1),
                             *number_between(-1, 1));
  RC_PRE(down.norm() > 0.1);
  const Eigen::Vector3d turned = level_rotation(down) * down.normalized();
  RC_ASSERT((turned + Eigen::Vector3d::UnitZ()).norm() < 1e-9);
}

}  // namespace
}  // namespace roomwise
