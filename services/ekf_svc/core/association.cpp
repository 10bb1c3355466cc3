#include "services/ekf_svc/core/association.h"

#include <Eigen/LU>

#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {
namespace {

/// An upper bound of S's largest eigenvalue without H: cov(a + b + c) <= 3 (cov a + cov b + cov c).
double spread_bound_m2(const SlamFilter& filter, std::size_t landmark, double range_m,
                       const Eigen::Matrix3d& pose_covariance) {
  return 3.0 * (range_m * range_m * pose_covariance(0, 0) + pose_covariance(1, 1) +
                pose_covariance(2, 2) + filter.landmark_covariance_m2(landmark).trace());
}

}  // namespace

double gate_99(int degrees_of_freedom) { return degrees_of_freedom <= 2 ? 9.2103 : 13.2767; }

Candidate compare(const SlamFilter& filter, std::size_t landmark, const Sighting& sighting,
                  const BodyObservation& seen) {
  const Residual residual = filter.observation_residual(landmark, seen);
  const Eigen::Matrix2d S = filter.innovation_covariance(residual);
  const double determinant = S.determinant();
  const SignatureDistance colour =
      distance(sighting.signature, filter.landmark(landmark).signature);
  Candidate candidate{.landmark = landmark, .gate_sq = gate_99(2 + colour.degrees_of_freedom)};
  if (!(determinant > 0.0)) return candidate;
  const Eigen::Vector2d& v = residual.innovation;
  candidate.mahalanobis_sq =
      (S(1, 1) * v.x() * v.x() - (S(0, 1) + S(1, 0)) * v.x() * v.y() + S(0, 0) * v.y() * v.y()) /
          determinant +
      colour.squared;
  return candidate;
}

Candidate find_identity(const SlamFilter& filter, const Sighting& sighting,
                        const BodyObservation& seen) {
  for (std::size_t l = 0; l < filter.landmark_count(); ++l) {
    const Landmark& landmark = filter.landmark(l);
    if (landmark.identity != sighting.identity || landmark.kind != sighting.kind) continue;
    return compare(filter, l, sighting, seen);
  }
  return {};
}

Candidate find_nearest(const SlamFilter& filter, const Sighting& sighting,
                       const BodyObservation& seen, double search_sq) {
  const Eigen::Vector2d p_map_m = transform(filter.pose(), seen.p_robot_m);
  const Eigen::Matrix3d pose_covariance = filter.pose_covariance();
  const double noise_m2 = seen.covariance_m2.trace();
  Candidate best;
  for (std::size_t l = 0; l < filter.landmark_count(); ++l) {
    const Landmark& landmark = filter.landmark(l);
    if (landmark.identity >= 0 || landmark.kind != sighting.kind) continue;
    const Eigen::Vector2d offset = filter.landmark_position_m(l) - filter.pose().position_m();
    const double spread_m2 = noise_m2 + spread_bound_m2(filter, l, offset.norm(), pose_covariance);
    if ((filter.landmark_position_m(l) - p_map_m).squaredNorm() > search_sq * spread_m2) continue;
    const Candidate candidate = compare(filter, l, sighting, seen);
    if (candidate.mahalanobis_sq < best.mahalanobis_sq) best = candidate;
  }
  return best;
}

}  // namespace roomwise::ekf
