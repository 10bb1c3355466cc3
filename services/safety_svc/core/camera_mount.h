#pragma once
#include <Eigen/Core>
#include <optional>

namespace roomwise::safety {

/// Where the camera is said to be, and how its image is made.
struct CameraSetup {
  Eigen::Vector3d p_robot_camera_m = Eigen::Vector3d::Zero();
  Eigen::Vector4d quat_wxyz{1.0, 0.0, 0.0, 0.0};  ///< R(quat) p_camera + p is in the robot frame
  double fy_px = 0.0;
  double cy_px = 0.0;
  int height_px = 0;
};

/// What follows from it for the floor.
struct CameraMount {
  Eigen::Vector3d up_in_camera = Eigen::Vector3d::Zero();  ///< the robot's z, unit length
  double height_m = 0.0;                                   ///< above the floor
  double floor_seen_from_m = 0.0;  ///< straight ahead, from the robot's centre
};

/// Nothing if the numbers make no camera that sees the floor ahead of it within 5 m.
std::optional<CameraMount> mount_of(const CameraSetup& setup);

/// True if the floor as measured (unit normal in the camera frame, up; camera's height above it) is
/// not where the mounting has it: the robot leans, or the camera was pushed. Not finite: true.
bool is_tilted(const CameraMount& mount, const Eigen::Vector3d& floor_normal,
               double floor_height_m);

}  // namespace roomwise::safety
