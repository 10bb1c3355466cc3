#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "services/segment_svc/core/ground_rows.h"
#include "services/segment_svc/core/segment_params.h"

namespace roomwise::segment {

/// One direction from the robot frame's origin.
struct BearingBin {
  double free_range_m = 0.0;   ///< floor is seen without a gap, from where it comes into view
  double unknown_ratio = 1.0;  ///< share of the direction's pixels that are unknown; 1: not in view
  /// To the nearest obstacle, wall or drop-off seen, lower than the robot, though no floor may be
  /// seen before it; 0: none within 6 m.
  double obstacle_range_m = 0.0;
};

/// How far the way is free along each bearing, 1 degree apart.
///
/// Free means seen as floor: the range ends at the first obstacle, wall or drop-off lower than the
/// robot, and at the first stretch longer than the camera's own resolution in which no floor was
/// seen. It starts where the nearest pixel sees the floor, or would if it had a reading: unknown is
/// never free. The blind stretch nearer than that is not judged here.
class FreeRange {
 public:
  static constexpr int kBins = 91;  ///< bin k looks at (k - 45) degrees, counter-clockwise

  explicit FreeRange(const SegmentParams& params) : robot_height_m_(params.robot_height_m) {}

  /// Centre of bin 0 and step [rad].
  static double first_bearing_rad();
  static double step_rad();

  /// A frame's rows one by one, between begin() and end().
  void begin();
  void add(const GroundRow& row);
  /// `row_gap_per_m2`: distance on the floor between two measured rows, over range squared [1/m].
  void end(double row_gap_per_m2, std::array<BearingBin, kBins>& bins) const;

 private:
  static constexpr int kCells = 120;  // of 5 cm: 6 m
  struct Direction {
    std::array<std::uint16_t, kCells> floor;
    std::array<std::uint16_t, kCells> blocked;
    std::array<std::uint16_t, kCells> unknown;
    int pixels;
    int unknown_pixels;
  };
  double free_range_m(const Direction& direction, double gap_per_m2) const;
  static double obstacle_range_m(const Direction& direction);

  double robot_height_m_;
  std::vector<Direction> directions_ = std::vector<Direction>(kBins);
  std::vector<std::int16_t> tangent_;  // of a row's pixels: slot of the table of bearings, or -1
};

}  // namespace roomwise::segment
