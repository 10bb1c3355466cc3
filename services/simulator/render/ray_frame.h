#pragma once
#include <Eigen/Geometry>

#include "common/image/rgbd_frame.h"

namespace roomwise::simulator {

/// The rays of an image: from `origin_m` along corner + u step_u + v step_v, world frame.
/// Directions have length 1 along the camera's z, so that distance along a ray is depth.
struct RayFrame {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d corner;
  Eigen::Vector3d step_u;
  Eigen::Vector3d step_v;

  Eigen::Vector3d direction(double u_px, double v_px) const {
    return corner + u_px * step_u + v_px * step_v;
  }
};

/// The rays through the pixels of `camera`.
inline RayFrame ray_frame(const PinholeCamera& camera, const Eigen::Isometry3d& T_world_camera) {
  const auto& R = T_world_camera.linear();
  return {T_world_camera.translation(),
          R * Eigen::Vector3d(-camera.cx_px / camera.fx_px, -camera.cy_px / camera.fy_px, 1.0),
          R.col(0) / camera.fx_px, R.col(1) / camera.fy_px};
}

/// The same rays after reflection: as if they came from the mirror image of their origin. Distance
/// along them goes on counting from that origin.
/// normal . p = offset_m is the mirror's plane.
inline RayFrame reflected(const RayFrame& rays, const Eigen::Vector3d& normal, double offset_m) {
  const Eigen::Matrix3d H = Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose();
  return {H * rays.origin_m + 2.0 * offset_m * normal, H * rays.corner, H * rays.step_u,
          H * rays.step_v};
}

}  // namespace roomwise::simulator
