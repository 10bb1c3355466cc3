#pragma once
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/edge_pixel.h"
#include "services/landmark_svc/core/region_of_interest.h"
#include "services/landmark_svc/core/reject_counts.h"

namespace roomwise::landmark {

/// What counts as a depth jump.
struct JumpEdgeParams {
  double jump_quanta = 4.0;          ///< smallest jump in disparity, in sensor quanta
  double jump_m = 0.06;              ///< and in depth
  double gap_max_px = 24.0;          ///< bad pixels bridged, at 640 px image width
  double gap_slope_quanta_px = 1.0;  ///< extra disparity asked for each bridged column
  int near_run_px = 6;               ///< unbroken surface asked for on the near side, at 640 px
                                     ///< image width; at least 4, at most 8 pixels
  int far_run_px = 2;                ///< pixels that must stay far on the far side
  double range_min_m = 0.6;          ///< trusted depths of the near pixel
  double range_max_m = 3.81;
  /// Whether an edge may stand before readings beyond 4095 mm, which are bad: marked is_open.
  bool finds_open = false;
};

/// Finds occluding edges in one pass over the rows of a depth image, O(pixels).
///
/// Two neighbouring good pixels of a row (bad data of up to gap_max_px between them is bridged)
/// make an edge at the nearer one if
///  - disparity jumps by >= jump_quanta and depth by >= jump_m,
///  - the jump is not what the near surface's own disparity slope predicts (on a plane disparity
///    is linear in the column, so a wall seen edge-on makes no edge however far the gap),
///  - the near side goes on unbroken for near_run_px: no flying pixel,
///  - the far side stays far for far_run_px: no speck of noise,
///  - the near pixel lies in the trusted range.
///
/// A reading beyond 4095 mm is bad, so alone it makes no edge. But it is no hole either: where
/// finds_open is set, such edges are found and marked for who can judge them in company.
class JumpEdgeFinder {
 public:
  /// Appends the edges inside `region` to `edges`, row by row, columns ascending; adds what was
  /// turned down to `rejected`. Allocates only if `edges` must grow or the image got wider.
  void find(const DepthImage& depth, const DisparityTable& table, const PixelRectangle& region,
            const JumpEdgeParams& params, std::vector<EdgePixel>& edges, RejectCounts& rejected);

 private:
  std::vector<std::uint8_t> changes_;
};

}  // namespace roomwise::landmark
