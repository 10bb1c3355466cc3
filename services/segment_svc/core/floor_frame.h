#pragma once
#include <Eigen/Geometry>

#include "services/segment_svc/core/floor_plane.h"

namespace roomwise::segment {

/// The robot frame (x forward, y left, z up from the floor) laid on the floor as it was found, so
/// that tilt is taken out. A point p of the camera frame lies at
/// (forward . p + forward_m, left . p + left_m, normal . p + height_m).
struct FloorFrame {
  FloorPlane floor;
  Eigen::Vector3d forward;  ///< robot x in the camera frame, unit length, along the floor
  Eigen::Vector3d left;     ///< robot y
  double forward_m = 0.0;   ///< of the camera
  double left_m = 0.0;
};

/// Robot x is the mounting's, laid flat. `floor` must not be square to it.
inline FloorFrame floor_frame(const FloorPlane& floor, const Eigen::Isometry3d& T_robot_camera) {
  const Eigen::Vector3d mounted_forward =
      T_robot_camera.linear().transpose() * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d forward =
      (mounted_forward - mounted_forward.dot(floor.normal) * floor.normal).normalized();
  return {.floor = floor,
          .forward = forward,
          .left = floor.normal.cross(forward),
          .forward_m = T_robot_camera.translation().x(),
          .left_m = T_robot_camera.translation().y()};
}

}  // namespace roomwise::segment
