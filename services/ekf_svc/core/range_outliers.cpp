#include "services/ekf_svc/core/range_outliers.h"

#include <cmath>

namespace roomwise::ekf {

Eigen::Matrix2d range_softening(const Residual& residual, const Eigen::Vector2d& p_robot_m,
                                const Eigen::Matrix2d& S, double sigmas) {
  const double range_m = p_robot_m.norm();
  const Eigen::Vector2d sight = p_robot_m / range_m;
  const double off_m = range_m - (p_robot_m - residual.innovation).norm();
  const double off_sigmas = std::abs(off_m) / std::sqrt(sight.dot(S * sight));
  // Also when something is not a number: the filter refuses that by name.
  if (!(sigmas > 0.0) || !(off_sigmas > sigmas)) return Eigen::Matrix2d::Zero();
  const double variance_m2 = sight.dot(residual.noise * sight);
  return (off_sigmas / sigmas - 1.0) * variance_m2 * sight * sight.transpose();
}

}  // namespace roomwise::ekf
