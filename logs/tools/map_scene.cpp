#include "logs/tools/map_scene.h"

#include <fmt/core.h>

#include "logs/tools/covariance_ellipse.h"
#include "logs/tools/score_trajectory.h"

namespace roomwise {
namespace {

Points2 places_of(const Trajectory& trajectory, const Pose2& T_world_path) {
  Points2 points;
  for (const auto& timed : trajectory) {
    points.push_back(transform(T_world_path, timed.pose.position_m()));
  }
  return points;
}

void add_map(const Recording& recording, const Pose2& T_world_map, MapScene& scene) {
  const Eigen::Matrix2d R = rotation2(T_world_map.heading_rad);
  for (const map_landmark_t& landmark : recording.map->map_landmarks) {
    const Eigen::Vector2d p_m = transform(T_world_map, {landmark.map_x_m, landmark.map_y_m});
    Eigen::Matrix2d covariance_m2;
    covariance_m2 << landmark.covariance_x_x_m2, landmark.covariance_x_y_m2,
        landmark.covariance_x_y_m2, landmark.covariance_y_y_m2;
    scene.landmarks.push_back({landmark.identity, p_m});
    scene.ellipses.push_back(ellipse_outline(p_m, R * covariance_m2 * R.transpose()));
  }
}

}  // namespace

MapScene map_scene_of(const Recording& recording) {
  MapScene scene;
  Pose2 T_world_map;
  Pose2 T_world_odom;
  if (const auto score = score_trajectory(recording.poses, recording.truth)) {
    T_world_map = T_world_odom = score->T_world_map_aligned;
    scene.caption = fmt::format("estimate aligned to truth, RMS {:.3f} m", score->ate_aligned_m);
  } else if (const auto dead_reckoning = score_trajectory(recording.odometry, recording.truth)) {
    T_world_odom = dead_reckoning->T_world_map_aligned;
    scene.caption =
        fmt::format("odometry aligned to truth, RMS {:.3f} m", dead_reckoning->ate_aligned_m);
  }
  scene.truth = places_of(recording.truth, Pose2{});
  scene.odometry = places_of(recording.odometry, T_world_odom);
  scene.estimate = places_of(recording.poses, T_world_map);
  scene.true_landmarks = recording.true_landmarks;
  if (recording.map) add_map(recording, T_world_map, scene);
  return scene;
}

MapBounds map_bounds(const MapScene& scene) {
  MapBounds bounds;
  bounds.hold(scene.truth);
  bounds.hold(scene.estimate);
  for (const MapPoint& landmark : scene.true_landmarks) bounds.hold(landmark.p_m);
  for (const MapPoint& landmark : scene.landmarks) bounds.hold(landmark.p_m);
  MapBounds drifted;
  drifted.hold(scene.odometry);
  if (drifted.empty()) return bounds;
  if (bounds.empty()) return drifted;
  const Eigen::Vector2d reach_m = 0.25 * bounds.size_m();
  MapBounds both = bounds;
  both.hold(drifted.low_m.cwiseMax(bounds.low_m - reach_m));
  both.hold(drifted.high_m.cwiseMin(bounds.high_m + reach_m));
  return both;
}

}  // namespace roomwise
