#include "services/landmark_svc/core/surface_plane.h"

#include <Eigen/Cholesky>

namespace roomwise::landmark {

void SurfacePlane::add(double u_px, double v_px, double disparity) {
  const Eigen::Vector3d row(1.0, u_px - u0_px_, v_px - v0_px_);
  normal_.noalias() += row * row.transpose();
  right_ += row * disparity;
}

bool SurfacePlane::solve() {
  const double count = normal_(0, 0);
  if (count < 1.0) return false;
  constexpr double kRidge_px2 = 1e-3;  // far below the spread of any real patch
  Eigen::Matrix3d ridged = normal_;
  ridged(1, 1) += kRidge_px2 * count;
  ridged(2, 2) += kRidge_px2 * count;
  plane_ = ridged.ldlt().solve(right_);
  return plane_.allFinite();
}

}  // namespace roomwise::landmark
