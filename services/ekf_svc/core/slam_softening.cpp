// Slam: how hard a sighting is to pull.
#include <cmath>

#include "services/ekf_svc/core/arc_innovation.h"
#include "services/ekf_svc/core/outline.h"
#include "services/ekf_svc/core/range_outliers.h"
#include "services/ekf_svc/core/slam.h"

namespace roomwise::ekf {

Residual Slam::softened_residual(std::size_t l, const BodyObservation& seen) const {
  Residual residual = range_softened(l, seen);
  const Landmark& landmark = filter_.landmark(l);
  if (!is_outline(landmark.kind)) return residual;
  residual.softening +=
      turned_softening(sight_rad(seen) - landmark.first_sight_rad, params_.outline_shift_m_per_rad);
  return residual;
}

double Slam::sight_rad(const BodyObservation& seen) const {
  return filter_.pose().heading_rad + std::atan2(seen.p_robot_m.y(), seen.p_robot_m.x());
}

Residual Slam::range_softened(std::size_t l, const BodyObservation& seen) const {
  const Residual chord = filter_.observation_residual(l, seen);
  Residual residual = unrolled(filter_, chord, seen);
  const Eigen::Matrix2d S = filter_.innovation_covariance(residual);
  if (residual.innovation == chord.innovation) {
    residual.softening = range_softening(residual, seen.p_robot_m, S, params_.range_outlier_sigmas);
    return residual;
  }
  const Eigen::Vector2d along = (seen.p_robot_m - chord.innovation).normalized();
  Residual range_alone = residual;
  range_alone.innovation = along * along.dot(residual.innovation);
  residual.softening =
      range_softening(range_alone, seen.p_robot_m.norm() * along, S, params_.range_outlier_sigmas);
  return residual;
}

}  // namespace roomwise::ekf
