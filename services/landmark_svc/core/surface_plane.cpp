#include "services/landmark_svc/core/surface_plane.h"

#include <Eigen/Cholesky>

namespace roomwise::landmark {

bool SurfacePlane::solve() {
  if (count_ < 1.0) return false;
  constexpr double kRidge_px2 = 1e-3;  // far below the spread of any real patch
  const double ridge = kRidge_px2 * count_;
  Eigen::Matrix3d normal;
  normal << count_, u_, v_, u_, uu_ + ridge, uv_, v_, uv_, vv_ + ridge;
  plane_ = normal.ldlt().solve(Eigen::Vector3d(d_, ud_, vd_));
  return plane_.allFinite();
}

}  // namespace roomwise::landmark
