#include "services/ekf_svc/core/association.h"

#include <Eigen/LU>

#include "services/ekf_svc/core/arc_innovation.h"
#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {

double mahalanobis_sq(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S) {
  const double determinant = S.determinant();
  if (!(determinant > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d& v = innovation;
  return (S(1, 1) * v.x() * v.x() - (S(0, 1) + S(1, 0)) * v.x() * v.y() + S(0, 0) * v.y() * v.y()) /
         determinant;
}

Candidate find_identity(const SlamFilter& filter, const Sighting& sighting,
                        const BodyObservation& seen) {
  for (std::size_t l = 0; l < filter.landmark_count(); ++l) {
    const Landmark& landmark = filter.landmark(l);
    if (landmark.identity != sighting.identity || landmark.kind != sighting.kind) continue;
    const Residual residual = unrolled(filter, filter.observation_residual(l, seen), seen);
    return {l, mahalanobis_sq(residual.innovation, filter.innovation_covariance(residual)) +
                   distance(sighting.signature, landmark.signature).squared};
  }
  return {};
}

}  // namespace roomwise::ekf
