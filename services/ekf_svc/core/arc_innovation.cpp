#include "services/ekf_svc/core/arc_innovation.h"

#include <cmath>

#include "services/ekf_svc/core/planar_group.h"

namespace roomwise::ekf {
namespace {

constexpr double kStraight_rad = 0.1;  // r (1 - cos 0.1) is 0.5 % of r
constexpr double kNearest_m = 0.1;     // no line of sight to speak of

}  // namespace

Residual unrolled(const SlamFilter& filter, const Residual& residual, const BodyObservation& seen) {
  const Eigen::Vector2d& z = seen.p_robot_m;
  const Eigen::Vector2d h = z - residual.innovation;
  const double range_m = h.norm();
  const double off_rad = std::atan2(h.x() * z.y() - h.y() * z.x(), h.dot(z));
  // Also when something is not a number: the filter refuses that by name.
  if (!(std::abs(off_rad) > kStraight_rad) || !(range_m > kNearest_m)) return residual;
  const Eigen::Vector2d along = h / range_m, across = quarter_turn(along);
  const Eigen::Matrix2d place_m2 = filter.innovation_covariance(residual) - residual.noise;
  if (across.dot(place_m2 * across) <= along.dot(place_m2 * along)) return residual;

  const Eigen::Matrix2d back = rotation2(-off_rad);
  Residual arc = residual;
  arc.innovation = (z.norm() - range_m) * along + range_m * off_rad * across;
  arc.noise = back * residual.noise * back.transpose();
  arc.calibration = back * residual.calibration;
  return arc;
}

}  // namespace roomwise::ekf
