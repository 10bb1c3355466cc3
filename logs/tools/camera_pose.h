#pragma once
#include <Eigen/Geometry>

#include "common/geometry/pose2.h"

namespace roomwise {

/// Poses of a hand-held camera, told as if a robot carried it. In all of this the world's z points
/// up, camera: z forward, x right, y down; robot: x forward, y left, z up, on the floor (z = 0)
/// straight below the camera, x along the optical axis as seen from above.

/// A rotation that turns `down_world` (any length but 0) to -z. Shape 3 x 3.
Eigen::Matrix3d level_rotation(const Eigen::Vector3d& down_world);

/// The robot below the camera. A camera that looks straight down or up: robot x is the image's up
/// or down.
Pose2 robot_below(const Eigen::Isometry3d& T_world_camera);

/// T_robot_camera of that robot: the camera's tilt and its height above z = 0.
Eigen::Isometry3d mounting_of(const Eigen::Isometry3d& T_world_camera);

/// T_robot_camera of a camera that looks straight ahead from `height_m`.
Eigen::Isometry3d level_mounting(double height_m);

}  // namespace roomwise
