#pragma once
#include <Eigen/Core>

namespace roomwise::landmark {

/// Least-squares plane through disparities of an image patch, D = a + s_u u + s_v v: exact for any
/// plane in space, whatever its slant.
class SurfacePlane {
 public:
  /// Coordinates are taken relative to (`u0_px`, `v0_px`), which should lie in the patch.
  SurfacePlane(double u0_px, double v0_px) : u0_px_(u0_px), v0_px_(v0_px) {}

  void add(double u_px, double v_px, double disparity);

  /// Solves for the plane. Slopes no point speaks for (all on one line) come out near 0 across it.
  /// False if there are no points.
  [[nodiscard]] bool solve();

  /// Disparity of the solved plane.
  double at(double u_px, double v_px) const {
    return plane_[0] + plane_[1] * (u_px - u0_px_) + plane_[2] * (v_px - v0_px_);
  }

 private:
  double u0_px_;
  double v0_px_;
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();
};

}  // namespace roomwise::landmark
