#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

/// Classes and distances of one frame, summed up.
struct ViewDistances {
  double mean_m = 0.0;  ///< of all readings: the thesis's average distance; 0: no reading
  std::array<double, kLabels.size()> class_fraction{};  ///< of all pixels, in the order of kLabels
  std::array<double, kLabels.size()> class_mean_m{};    ///< of the class's readings; 0: none
};

/// Sums up a frame; `labels` are height x width. Readings beyond `range_max_m` do not count.
///
/// The average distance counts the floor as if it were in the way, so that it never meant the
/// distance of an obstacle; Corridor's near distance does.
ViewDistances measure_distances(const DepthImage& depth, double range_max_m,
                                const std::vector<std::uint8_t>& labels);

}  // namespace roomwise::segment
