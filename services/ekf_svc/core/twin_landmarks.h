#pragma once
#include <span>
#include <vector>

#include "services/ekf_svc/core/landmark_pair.h"
#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

/// Finds landmarks that were begun a second time while the robot was not sure enough of its place,
/// once it is: two that look the same, within a few centimetres of each other, whose distance is
/// known to a few centimetres, where no third one could be meant.
class TwinLandmarks {
 public:
  explicit TwinLandmarks(const SlamFilter& filter);

  /// Pairs to be merged now, after `travel_m` of way. The answer lives until the next call.
  std::span<const LandmarkPair> find(double travel_m);

 private:
  struct Fit {
    double squared;
    bool is_well_known;
  };
  Fit fit(std::size_t recent, std::size_t old) const;
  std::size_t only_twin_of(std::size_t recent) const;

  const SlamFilter* filter_;
  std::vector<LandmarkPair> pairs_;
};

}  // namespace roomwise::ekf
