#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "common/channels.h"
#include "tests/support/events.h"

namespace roomwise {

inline constexpr std::int64_t kMade_utime = 1'500'000'000'000'000;

/// A drive of 5 s along a bend: TRUTH with two landmarks, ODOMETRY that turns too much, POSE that
/// is right but for its frame (map: pose at start), and the map. 10 Hz.
inline std::vector<LogEvent> made_drive() {
  std::vector<LogEvent> events;
  for (int i = 0; i <= 50; ++i) {
    const std::int64_t utime = kMade_utime + i * 100'000;
    const double t = 0.1 * i;
    truth_t truth{};
    truth.utime = utime;
    truth.seq = i + 1;
    truth.true_x_m = 1.0 - std::sin(t);
    truth.true_y_m = 2.0 + t;
    truth.true_heading_rad = std::numbers::pi / 2;
    if (i % 10 == 0) {
      truth.true_landmarks = {{7, 6, 3.0, 2.0}, {8, 6, 1.0, 5.0}};
      truth.landmark_count = 2;
    }
    events.push_back(event_of(channels::kTruth, utime, truth));
    pose_t pose{};  // the map frame is turned by 90 degrees and starts at truth's first pose
    pose.utime = utime;
    pose.seq = i + 1;
    pose.x_m = t;
    pose.y_m = std::sin(t);
    events.push_back(event_of(channels::kPose, utime, pose));
    odometry_t odometry{};
    odometry.utime = utime;
    odometry.seq = i + 1;
    odometry.x_m = t;
    odometry.y_m = std::sin(t) + 0.1 * t * t;
    odometry.heading_rad = 0.1 * t;
    events.push_back(event_of(channels::kOdometry, utime, odometry));
  }
  landmark_map_t map{};
  map.utime = kMade_utime + 5'000'000;
  map.seq = 1;
  map.map_landmarks.resize(2);
  map.map_landmarks[0].identity = 7;  // at (3, 2) in the world
  map.map_landmarks[0].map_x_m = 0.0;
  map.map_landmarks[0].map_y_m = -2.0;
  map.map_landmarks[1].identity = 8;
  map.map_landmarks[1].map_x_m = 3.0;
  map.map_landmarks[1].map_y_m = 0.0;
  map.map_count = 2;
  events.push_back(event_of(channels::kLandmarkMap, map.utime, map));
  return events;
}

}  // namespace roomwise
