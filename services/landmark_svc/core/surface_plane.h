#pragma once
#include <Eigen/Core>

namespace roomwise::landmark {

/// Least-squares plane through disparities of an image patch, D = a + s_u u + s_v v: exact for any
/// plane in space, whatever its slant.
class SurfacePlane {
 public:
  /// Coordinates are taken relative to (`u0_px`, `v0_px`), which should lie in the patch.
  SurfacePlane(double u0_px, double v0_px) : u0_px_(u0_px), v0_px_(v0_px) {}

  void add(double u_px, double v_px, double disparity) {
    const double u = u_px - u0_px_;
    const double v = v_px - v0_px_;
    count_ += 1.0;
    u_ += u;
    v_ += v;
    uu_ += u * u;
    uv_ += u * v;
    vv_ += v * v;
    d_ += disparity;
    ud_ += u * disparity;
    vd_ += v * disparity;
  }

  /// Solves for the plane. Slopes no point speaks for (all on one line) come out near 0 across it.
  /// False if there are no points.
  [[nodiscard]] bool solve();

  /// Disparity of the solved plane.
  double at(double u_px, double v_px) const {
    return plane_[0] + plane_[1] * (u_px - u0_px_) + plane_[2] * (v_px - v0_px_);
  }

  /// Change of disparity from one column to the next.
  double slope_per_px() const { return plane_[1]; }

 private:
  double u0_px_;
  double v0_px_;
  double count_ = 0.0;  // sums over the points, u and v relative
  double u_ = 0.0;
  double v_ = 0.0;
  double uu_ = 0.0;
  double uv_ = 0.0;
  double vv_ = 0.0;
  double d_ = 0.0;
  double ud_ = 0.0;
  double vd_ = 0.0;
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();
};

}  // namespace roomwise::landmark
