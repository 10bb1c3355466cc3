#pragma once
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/color_weight.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/edge_pixel.h"
#include "services/landmark_svc/core/region_of_interest.h"
#include "services/landmark_svc/core/reject_counts.h"

namespace roomwise::landmark {

/// The slope-difference detector's knobs.
struct SlopeEdgeParams {
  double threshold_mm_per_px = 100.0;  ///< the thesis compares 0, 100 and 1000
  double range_min_m = 1.22;           ///< trusted depths of the near pixel
  double range_max_m = 3.81;
};

/// The slope-difference detector, O(pixels), kept beside JumpEdgeFinder for comparison.
///
/// For each good pixel i that is nearer than one of its neighbours l, r (the closest good pixels of
/// its row on either side, bad data between them is bridged whatever its width):
///
///   S_r = (z_r - z_i) / (u_r - u_i),  S_l = (z_i - z_l) / (u_i - u_l),  D = |S_r - S_l|  [mm/px]
///   W   = alpha C / sigma_C + beta D / sigma_D(z_i),   alpha + beta = 1
///
/// with C the distance in RGB to the farther neighbour; i is an edge pixel if W exceeds the
/// threshold in the same measure, threshold / sigma_D. Both terms are in multiples of their own
/// noise, so that neither's unit decides. Without colour this is D > threshold.
///   sigma_C = sqrt(6) * noise_levels: two pixels, three channels;
///   sigma_D = sqrt(6) * half a disparity quantum at z_i: one reading counts twice, two once.
class SlopeEdgeFinder {
 public:
  /// Appends the edges inside `region` to `edges`, row by row, columns ascending. `alpha_ratio` is
  /// taken as 0 where `color` is not available. Allocates only if `edges` must grow.
  void find(const DepthImage& depth, const DisparityTable& table, const ColorAtDepth& color,
            const PixelRectangle& region, const SlopeEdgeParams& params,
            const ColorWeightParams& color_params, double alpha_ratio,
            std::vector<EdgePixel>& edges, RejectCounts& rejected) const;
};

}  // namespace roomwise::landmark
