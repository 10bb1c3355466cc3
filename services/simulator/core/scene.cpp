#include "services/simulator/core/scene.h"

#include <cmath>

namespace roomwise::simulator {
namespace {

double way_length_m(const std::vector<Eigen::Vector2d>& way_m) {
  double length_m = 0.0;
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    length_m += (way_m[(i + 1) % way_m.size()] - way_m[i]).norm();
  }
  return length_m;
}

Pose2 facing(const Eigen::Vector2d& p_m, const Eigen::Vector2d& direction) {
  return {p_m.x(), p_m.y(), wrap_angle(std::atan2(direction.y(), direction.x()))};
}

/// `along_m` in [0, length of the closed way).
Pose2 pose_on_way(const std::vector<Eigen::Vector2d>& way_m, double along_m) {
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    const Eigen::Vector2d leg = way_m[(i + 1) % way_m.size()] - way_m[i];
    const double leg_m = leg.norm();
    if (along_m < leg_m) return facing(way_m[i] + leg * (along_m / leg_m), leg);
    along_m -= leg_m;
  }
  return facing(way_m.front(), way_m[1] - way_m[0]);  // rounding at the very end
}

}  // namespace

Pose2 walker_pose(const Walker& walker, double t_s) {
  if (walker.way_m.empty()) return {};
  const double length_m = way_length_m(walker.way_m);
  if (!(length_m > 0.0)) return {walker.way_m[0].x(), walker.way_m[0].y(), 0.0};
  const double gone_m = walker.start_m + walker.speed_mps * t_s;
  return pose_on_way(walker.way_m, gone_m - length_m * std::floor(gone_m / length_m));
}

Eigen::Isometry3d T_robot_camera(const CameraMount& mount) {
  Eigen::Matrix3d R_forward_camera;  // forward: x ahead, y left, z up
  R_forward_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << mount.x_m, mount.y_m, mount.z_m;
  T.linear() = Eigen::AngleAxisd(mount.yaw_rad, Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(mount.pitch_down_rad, Eigen::Vector3d::UnitY()) * R_forward_camera;
  return T;
}

const Path* find_path(const Scene& scene, std::string_view name) {
  for (const Path& path : scene.paths) {
    if (path.name == name) return &path;
  }
  return nullptr;
}

}  // namespace roomwise::simulator
