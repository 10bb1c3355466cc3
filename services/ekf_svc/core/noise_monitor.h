#pragma once
#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

/// Watches the normalised innovation of accepted pairs. Where it stays above what chi^2 allows, the
/// sensor is worse than it says: the noise of landmarks is scaled up until the two agree again.
class NoiseMonitor {
 public:
  /// After an update that was used.
  void record(const InnovationStatistics& innovation);

  /// Factor on the covariance of what is seen, 1 to 4.
  double ratio() const { return ratio_; }

 private:
  double squared_ = 0.0;  // of the window
  int degrees_of_freedom_ = 0;
  double ratio_ = 1.0;
};

}  // namespace roomwise::ekf
