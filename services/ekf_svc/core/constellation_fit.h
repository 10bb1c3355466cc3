#pragma once
#include <Eigen/Core>
#include <span>

#include "common/geometry/pose2.h"
#include "services/ekf_svc/core/landmark_pair.h"
#include "services/ekf_svc/core/map_snapshot.h"

namespace roomwise::ekf {

/// How a small map lies in a large one.
struct ConstellationFit {
  Pose2 T_map_local;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (heading, x, y)
  double squared = 0.0;  ///< normalised residual; chi^2 with 2 pairs - 3 degrees of freedom
  /// ln of the density [1/m^2 per pair] of landmarks where the pairs are, were this the place: the
  /// residuals' Gaussian, summed over all motions near this one (Laplace), none likelier before.
  double log_density = 0.0;
};

/// The rigid motion that brings the pairs' recent landmarks (of `local`) onto their old ones (of
/// `map`), weighted by the joint covariance of both maps: two Gauss-Newton steps from
/// `T_map_local`. At least two pairs.
ConstellationFit fit_constellation(const MapSnapshot& map, const MapSnapshot& local,
                                   std::span<const LandmarkPair> pairs, const Pose2& T_map_local);

}  // namespace roomwise::ekf
