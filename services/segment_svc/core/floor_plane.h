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
  double roll_rad() const { return std::atan2(normal.x(), std::hypot(normal.y(), normal.z())); }
};

/// The floor as the camera's mounting would have it.
inline FloorPlane mounted_floor(const Eigen::Isometry3d& T_robot_camera) {
  return {.normal = T_robot_camera.linear().transpose() * Eigen::Vector3d::UnitZ(),
          .height_m = T_robot_camera.translation().z()};
}

}  // namespace roomwise::segment
