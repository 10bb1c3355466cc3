#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_frame.h"
#include "services/segment_svc/core/labels.h"
#include "services/segment_svc/core/segment_params.h"

namespace roomwise::segment {

/// Distances of one frame, summed up.
struct ViewDistances {
  double mean_m = 0.0;  ///< of all readings: the thesis's average distance; 0: no reading
  std::array<double, kLabels.size()> class_fraction{};  ///< of all pixels, in the order of kLabels
  std::array<double, kLabels.size()> class_mean_m{};    ///< of the class's readings; 0: none

  /// Forward distance that 2 % of the points in the swept corridor which are not floor and lower
  /// than the robot lie nearer than; 0: there are none.
  double near_m = 0.0;
  double corridor_unknown_ratio = 0.0;  ///< unknown among the pixels that look into the corridor
};

/// Averages over a frame in one pass. The average distance (thesis, section 4.1) counts the floor
/// as if it were in the way; the near quantile in the corridor beside it does not.
class DistanceMeter {
 public:
  explicit DistanceMeter(const SegmentParams& params) : params_(params) {}

  ViewDistances measure(const RgbdFrame& frame, const CameraView& view,
                        const FloorFrame& frame_of_floor, const std::vector<std::uint8_t>& labels);

 private:
  void measure_classes(const RgbdFrame& frame, const CameraView& view,
                       const std::vector<std::uint8_t>& labels, ViewDistances& distances) const;
  void measure_corridor(const RgbdFrame& frame, const CameraView& view,
                        const FloorFrame& frame_of_floor, const std::vector<std::uint8_t>& labels,
                        ViewDistances& distances);
  double near_quantile_m() const;

  static constexpr int kCells = 1000;  // of 1 cm

  SegmentParams params_;
  std::array<int, kCells> in_corridor_{};  // points not floor, by forward distance
};

}  // namespace roomwise::segment
