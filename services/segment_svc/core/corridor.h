#pragma once
#include <array>

#include "services/segment_svc/core/ground_rows.h"
#include "services/segment_svc/core/segment_params.h"

namespace roomwise::segment {

/// What stands in the way straight ahead.
struct CorridorView {
  /// Forward distance that 2 % of the corridor's points that are not floor and lower than the robot
  /// lie nearer than; 0: there are none.
  double near_m = 0.0;
  double unknown_ratio = 1.0;  ///< unknown among the pixels that look into the corridor; 1: none do
};

/// Looks into the corridor the robot sweeps when it drives straight on.
class Corridor {
 public:
  explicit Corridor(const SegmentParams& params);

  /// A frame's rows one by one, between begin() and end().
  void begin();
  void add(const GroundRow& row);
  CorridorView end() const;

 private:
  double near_quantile_m() const;

  static constexpr int kCells = 1000;  // of 1 cm

  float half_width_m_;
  float length_m_;
  float robot_height_m_;
  std::array<int, kCells> blocked_{};  // points that are not floor, by forward distance
  int unknown_ = 0;
  int known_ = 0;
};

}  // namespace roomwise::segment
