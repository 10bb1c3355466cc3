#pragma once
#include <Eigen/Geometry>
#include <cmath>

namespace roomwise::segment {

/// The floor as the camera sees it: a point p of the camera frame is `normal . p + height_m` above
/// it.
struct FloorPlane {
  Eigen::Vector3d normal{0.0, -1.0, 0.0};  ///< unit length, up
  double height_m = 0.0;                   ///< of the camera

  /// The camera's tilt: positive looks down.
  double pitch_rad() const { return std::atan2(-normal.z(), -normal.y()); }
  /// The camera's lean: positive to its right.
  double roll_rad() const { return std::atan2(-normal.x(), std::hypot(normal.y(), normal.z())); }
};

/// The floor as the camera's mounting would have it.
inline FloorPlane mounted_floor(const Eigen::Isometry3d& T_robot_camera) {
  return {.normal = T_robot_camera.linear().transpose() * Eigen::Vector3d::UnitZ(),
          .height_m = T_robot_camera.translation().z()};
}

/// A floor that a camera saw from one mounting, as it sees it from another.
inline FloorPlane carried_floor(const FloorPlane& floor, const Eigen::Isometry3d& T_robot_before,
                                const Eigen::Isometry3d& T_robot_now) {
  const Eigen::Vector3d normal_robot = T_robot_before.linear() * floor.normal;
  const Eigen::Vector3d moved_m = T_robot_now.translation() - T_robot_before.translation();
  return {.normal = T_robot_now.linear().transpose() * normal_robot,
          .height_m = floor.height_m + normal_robot.dot(moved_m)};
}

}  // namespace roomwise::segment
