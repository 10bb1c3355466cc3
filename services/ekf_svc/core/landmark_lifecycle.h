#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/ekf_params.h"
#include "services/ekf_svc/core/lost_monitor.h"
#include "services/ekf_svc/core/virtual_scan.h"

namespace roomwise::ekf {

/// Lets go of landmarks that are no longer there. A landmark in the middle of the view that is not
/// seen says nothing by itself: it may be hidden. Only where the camera looked through the place it
/// should be at, at something farther away, it counts against it: a virtual scan's beam, or another
/// landmark behind it.
class LandmarkLifecycle {
 public:
  LandmarkLifecycle(const SlamFilter& filter, const EkfParams& params);

  /// Weighs a frame. Returns landmarks to be removed, highest number first; lives until the next
  /// call.
  std::span<const std::size_t> weigh(SlamFilter& filter, std::span<const Sighting> sightings,
                                     std::span<const Verdict> verdicts,
                                     std::span<const Candidate> candidates,
                                     const VirtualScan& scan);

  /// Nearly everything the map promises is looked through: the robot is not where it thinks.
  bool says_lost() const { return lost_monitor_.says_lost(); }
  void clear() { lost_monitor_.clear(); }

 private:
  bool is_looked_through(const Eigen::Vector2d& p_robot_m, double sigma_m,
                         std::span<const Sighting> sightings, const VirtualScan& scan) const;

  double half_view_rad_;
  double range_min_m_;
  double range_max_m_;
  LostMonitor lost_monitor_;
  std::vector<bool> is_seen_;  // per landmark, in this frame
  std::vector<std::size_t> leaving_;
};

}  // namespace roomwise::ekf
