#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_frame.h"
#include "services/segment_svc/core/segment_params.h"

namespace roomwise::segment {

/// One direction from the robot frame's origin.
struct BearingBin {
  double free_range_m = 0.0;  ///< floor is seen without a gap, from where it is first seen, to here
  double unknown_ratio = 1.0;  ///< share of the direction's pixels that are unknown; 1: not in view
};

/// How far the way is free along each bearing, 1 degree apart.
///
/// Free means seen as floor: the range ends at the first obstacle, wall or drop-off lower than the
/// robot, and at the first stretch longer than the camera's own resolution in which no floor was
/// seen. Unknown is never free. The blind stretch before the first floor pixel is not judged here.
class FreeRange {
 public:
  static constexpr int kBins = 91;  ///< bin k looks at (k - 45) degrees, counter-clockwise

  explicit FreeRange(const SegmentParams& params) : params_(params) {}

  /// Centre of bin 0 and step [rad].
  static double first_bearing_rad();
  static double step_rad();

  /// `labels`: height x width, as GeometryLabels writes them.
  const std::array<BearingBin, kBins>& measure(const RgbdFrame& frame, const CameraView& view,
                                               const FloorFrame& frame_of_floor,
                                               const std::vector<std::uint8_t>& labels);

 private:
  static constexpr int kCells = 120;  // of 5 cm: 6 m
  struct Direction {
    std::array<std::uint16_t, kCells> floor{};
    std::array<std::uint16_t, kCells> blocked{};
    int pixels = 0;
    int unknown = 0;
  };
  void count(const RgbdFrame& frame, const CameraView& view, const FloorFrame& frame_of_floor,
             const std::vector<std::uint8_t>& labels);
  double free_range_m(const Direction& direction, double gap_per_m2) const;

  SegmentParams params_;
  std::vector<Direction> directions_ = std::vector<Direction>(kBins);
  std::array<BearingBin, kBins> bins_{};
};

}  // namespace roomwise::segment
