#include "services/safety_svc/core/camera_mount.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {
namespace {

constexpr double kUnitTolerance = 0.01;  // of a quaternion's and a normal's length
constexpr double kFloorWithin_m = 5.0;
constexpr double kUpright = 0.5;  // the robot's z leans no more than 60 degrees in the image

// either bound: no number that a double can hold is 0.01 away from 1.
bool is_unit(double length) { return std::abs(length - 1.0) < kUnitTolerance; }

}  // namespace

std::optional<CameraMount> mount_of(const CameraSetup& setup) {
  const Eigen::Vector4d& q = setup.quat_wxyz;
  const Eigen::Vector3d& p_m = setup.p_robot_camera_m;
  // Not finite compares false and is refused with the rest.
  if (!is_unit(q.norm()) || !(p_m.norm() < kFloorWithin_m)) return std::nullopt;
  const Eigen::Matrix3d R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Eigen::Vector3d lowest(0.0, (setup.height_px - 1 - setup.cy_px) / setup.fy_px, 1.0);
  const Eigen::Vector3d ray = R * lowest;
  const double reach_m = p_m.z() * ray.head<2>().norm() / -ray.z();
  const Eigen::Vector3d up_in_camera = R.transpose() * Eigen::Vector3d::UnitZ();
  // either bound: 60 degrees, a round number, is far from how any camera is mounted.
  const bool is_upright = -up_in_camera.y() > kUpright;
  const bool sees_floor_ahead = std::min({ray.x(), -ray.z(), p_m.z()}) > 0.0;
  // either bound: 5 m, a round number, is far from how any camera is mounted.
  if (!is_upright || !sees_floor_ahead || !(reach_m < kFloorWithin_m)) return std::nullopt;
  return CameraMount{.up_in_camera = up_in_camera,
                     .height_m = p_m.z(),
                     .floor_seen_from_m = p_m.head<2>().norm() + reach_m};
}

bool is_tilted(const CameraMount& mount, const Eigen::Vector3d& floor_normal,
               double floor_height_m) {
  const double across = mount.up_in_camera.cross(floor_normal).norm();
  const double angle_rad = std::atan2(across, mount.up_in_camera.dot(floor_normal));
  // either bound: measured to a tenth of a degree and a millimetre.
  const bool is_level = angle_rad <= kTilt_rad;
  // either bound: as above.
  const bool is_as_high = std::abs(floor_height_m - mount.height_m) <= kHeight_m;
  return !(is_unit(floor_normal.norm()) && is_level && is_as_high);
}

}  // namespace roomwise::safety
