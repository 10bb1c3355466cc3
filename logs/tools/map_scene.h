#pragma once
#include <limits>
#include <string>
#include <vector>

#include "logs/tools/recording.h"

namespace roomwise {

/// Corners of what is to be seen, in the world.
struct MapBounds {
  Eigen::Vector2d low_m = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high_m = -low_m;

  void hold(const Eigen::Vector2d& p_m) {
    low_m = low_m.cwiseMin(p_m);
    high_m = high_m.cwiseMax(p_m);
  }
  void hold(const Points2& points) {
    for (const Eigen::Vector2d& p_m : points) hold(p_m);
  }
  bool empty() const { return low_m.x() > high_m.x(); }
  Eigen::Vector2d size_m() const { return high_m - low_m; }
};

/// Everything the picture shows, in one frame.
struct MapScene {
  Points2 truth;
  Points2 odometry;
  Points2 estimate;
  std::vector<MapPoint> true_landmarks;
  std::vector<MapPoint> landmarks;
  std::vector<Points2> ellipses;  ///< of the landmarks
  std::string caption;

  /// The path whose start is marked.
  const Points2& start_path() const {
    return !truth.empty() ? truth : !estimate.empty() ? estimate : odometry;
  }
};

/// The recording in the frame of TRUTH, where the estimate is put by its best rigid alignment and
/// odometry along with it; without TRUTH in the map frame.
MapScene map_scene_of(const Recording& recording);

/// What is known well decides; odometry, which may have drifted anywhere, adds half as much again.
MapBounds map_bounds(const MapScene& scene);

}  // namespace roomwise
