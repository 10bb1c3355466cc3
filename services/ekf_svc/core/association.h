#pragma once
#include <cstddef>
#include <limits>

#include "services/ekf_svc/core/sighting.h"
#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

/// The landmark that suits a sighting best, and how well.
struct Candidate {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t landmark = kNone;
  double mahalanobis_sq = std::numeric_limits<double>::infinity();
};

/// innovation^T S^-1 innovation; infinite if S is not positive definite.
double mahalanobis_sq(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S);

/// The landmark of the sighting's (known) identity, with the normalised innovation of the pair,
/// colour included; place and colour are compared, never searched.
Candidate find_identity(const SlamFilter& filter, const Sighting& sighting,
                        const BodyObservation& seen);

}  // namespace roomwise::ekf
