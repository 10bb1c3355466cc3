#include "logs/tools/camera_pose.h"

namespace roomwise {

Eigen::Matrix3d level_rotation(const Eigen::Vector3d& down_world) {
  return Eigen::Quaterniond::FromTwoVectors(down_world, -Eigen::Vector3d::UnitZ())
      .toRotationMatrix();
}

Pose2 robot_below(const Eigen::Isometry3d& T_world_camera) {
  constexpr double kSmallestLevelPart = 1e-3;
  const Eigen::Matrix3d R = T_world_camera.linear();
  Eigen::Vector3d forward = R.col(2);
  if (forward.head<2>().norm() < kSmallestLevelPart) forward = R.col(1) * forward.z();
  const Eigen::Vector3d p = T_world_camera.translation();
  return {p.x(), p.y(), wrap_angle(std::atan2(forward.y(), forward.x()))};
}

Eigen::Isometry3d mounting_of(const Eigen::Isometry3d& T_world_camera) {
  const Pose2 robot = robot_below(T_world_camera);
  Eigen::Isometry3d T_world_robot = Eigen::Isometry3d::Identity();
  T_world_robot.translation() << robot.x_m, robot.y_m, 0.0;
  T_world_robot.linear() =
      Eigen::AngleAxisd(robot.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T_world_robot.inverse() * T_world_camera;
}

Eigen::Isometry3d level_mounting(double height_m) {
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.translation().z() = height_m;
  T_robot_camera.linear() << 0, 0, 1,  //
      -1, 0, 0,                        //
      0, -1, 0;
  return T_robot_camera;
}

}  // namespace roomwise
