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
  double gate_sq = 0.0;  ///< 99 % of right pairs are below
};

/// chi^2 quantile at 99 % for 2 or 4 degrees of freedom.
double gate_99(int degrees_of_freedom);

/// Squared Mahalanobis distance of a pair: innovation^T S^-1 innovation + the signatures'. Infinite
/// if S is not positive definite.
Candidate compare(const SlamFilter& filter, std::size_t landmark, const Sighting& sighting,
                  const BodyObservation& seen);

/// The landmark of the sighting's (known) identity; place and colour are compared, never searched.
Candidate find_identity(const SlamFilter& filter, const Sighting& sighting,
                        const BodyObservation& seen);

/// The nearest landmark, by Mahalanobis distance, among those of the sighting's kind whose identity
/// is unknown too. Landmarks certainly beyond `search_sq` may be passed over.
Candidate find_nearest(const SlamFilter& filter, const Sighting& sighting,
                       const BodyObservation& seen, double search_sq);

}  // namespace roomwise::ekf
