#include "logs/tools/recording.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "common/bus/bus.h"

namespace roomwise {
namespace {

constexpr std::int64_t kLatest_utime = std::int64_t{1} << 60;  // differences cannot overflow
constexpr double kFarthest_m = 1e6;

bool is_time(std::int64_t utime) { return utime >= 0 && utime <= kLatest_utime; }

bool are_coordinates(std::initializer_list<double> values) {
  return std::ranges::all_of(values, [](double v) { return std::abs(v) <= kFarthest_m; });
}

void add_pose(Bus& bus, std::int64_t utime, const Pose2& pose, Trajectory& trajectory) {
  if (!is_time(utime) || !are_coordinates({pose.x_m, pose.y_m, pose.heading_rad})) {
    bus.count("pose_not_usable");
    return;
  }
  trajectory.push_back({utime, {pose.x_m, pose.y_m, wrap_angle(pose.heading_rad)}});
}

void add_true_landmarks(Bus& bus, const truth_t& truth, std::vector<MapPoint>& landmarks) {
  if (truth.true_landmarks.empty()) return;
  landmarks.clear();
  for (const true_landmark_t& landmark : truth.true_landmarks) {
    if (are_coordinates({landmark.true_x_m, landmark.true_y_m})) {
      landmarks.push_back(
          {landmark.identity, {landmark.true_x_m, landmark.true_y_m}, landmark.kind});
    } else {
      bus.count("true_landmark_not_usable");
    }
  }
}

void add_scan(Bus& bus, const landmark_list_t& message, std::vector<Eigen::Vector2f>& scan) {
  scan.reserve(message.scan_x_m.size());
  for (std::size_t i = 0; i < message.scan_x_m.size(); ++i) {
    const Eigen::Vector2f point(message.scan_x_m[i], message.scan_y_m[i]);
    if (are_coordinates({point.x(), point.y()})) {
      scan.push_back(point);
    } else {
      bus.count("scan_point_not_usable");
    }
  }
}

void add_seen(Bus& bus, const landmark_list_t& message, std::vector<SeenFrame>& frames) {
  if (message.frame_seq == 0) return;  // of no camera frame
  if (!is_time(message.utime)) {
    bus.count("landmarks_time_not_usable");
    return;
  }
  SeenFrame& frame = frames.emplace_back();
  frame.utime = message.utime;
  frame.range_min_m = message.range_min_m;
  frame.range_max_m = message.range_max_m;
  add_scan(bus, message, frame.scan_robot_m);
  for (const landmark_observation_t& seen : message.landmarks) {
    if (!are_coordinates({seen.range_m, seen.bearing_rad})) {
      bus.count("landmark_not_usable");
      continue;
    }
    const Eigen::Vector2d toward(std::cos(seen.bearing_rad), std::sin(seen.bearing_rad));
    frame.landmarks.push_back({message.utime, seen.kind, seen.moving != 0, seen.range_m * toward});
  }
}

void set_map(Bus& bus, const landmark_map_t& message, Recording& recording) {
  recording.map = message;
  auto& landmarks = recording.map->map_landmarks;
  const auto not_usable = std::erase_if(landmarks, [](const map_landmark_t& landmark) {
    return !are_coordinates({landmark.map_x_m, landmark.map_y_m, landmark.covariance_x_x_m2,
                             landmark.covariance_x_y_m2, landmark.covariance_y_y_m2});
  });
  recording.map->map_count = static_cast<std::int32_t>(landmarks.size());
  if (not_usable > 0) bus.count("map_landmark_not_usable", static_cast<std::int64_t>(not_usable));
}

}  // namespace

std::vector<MapPoint> Recording::map_points() const {
  std::vector<MapPoint> points;
  if (!map) return points;
  for (const map_landmark_t& landmark : map->map_landmarks) {
    points.push_back({landmark.identity, {landmark.map_x_m, landmark.map_y_m}, 0});
  }
  return points;
}

void gather(Bus& bus, Recording& recording) {
  bus.subscribe(channels::kPose, [&](const pose_t& m) {
    add_pose(bus, m.utime, {m.x_m, m.y_m, m.heading_rad}, recording.poses);
  });
  bus.subscribe(channels::kOdometry, [&](const odometry_t& m) {
    add_pose(bus, m.utime, {m.x_m, m.y_m, m.heading_rad}, recording.odometry);
  });
  bus.subscribe(channels::kTruth, [&](const truth_t& m) {
    add_pose(bus, m.utime, {m.true_x_m, m.true_y_m, m.true_heading_rad}, recording.truth);
    add_true_landmarks(bus, m, recording.true_landmarks);
  });
  bus.subscribe(channels::kLandmarkMap,
                [&](const landmark_map_t& m) { set_map(bus, m, recording); });
  bus.subscribe(channels::kLandmarks, [&](const landmark_list_t& m) {
    add_seen(bus, m, recording.seen_frames);
    if (m.count > 0 && is_time(m.utime)) recording.sightings.push_back(m.utime);
  });
}

void sort_by_time(Recording& recording) {
  for (Trajectory* trajectory : {&recording.poses, &recording.odometry, &recording.truth}) {
    std::ranges::stable_sort(*trajectory, {}, &TimedPose2::utime);
  }
  std::ranges::sort(recording.sightings);
}

}  // namespace roomwise
