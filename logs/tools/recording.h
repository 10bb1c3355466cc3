#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "logs/tools/score_map.h"
#include "logs/tools/trajectory.h"
#include "roomwise/landmark_map_t.hpp"

namespace roomwise {

class Bus;

/// One element of LANDMARKS.
struct SeenLandmark {
  std::int64_t utime = 0;
  std::int8_t kind = 0;
  bool moving = false;
  Eigen::Vector2d p_robot_m{0.0, 0.0};
};

/// One LANDMARKS message that came of a camera frame.
struct SeenFrame {
  std::int64_t utime = 0;
  std::vector<SeenLandmark> landmarks;
  double range_min_m = 0.0;                   ///< looked for from here
  double range_max_m = 0.0;                   ///< to here
  std::vector<Eigen::Vector2f> scan_robot_m;  ///< as precise as the message: a log has thousands
};

/// What a log says of where the robot and the landmarks are.
struct Recording {
  Trajectory poses;                      ///< POSE
  Trajectory odometry;                   ///< ODOMETRY
  Trajectory truth;                      ///< TRUTH
  std::vector<MapPoint> true_landmarks;  ///< the newest list that was not empty
  std::optional<landmark_map_t> map;     ///< the last
  std::vector<SeenFrame> seen_frames;    ///< LANDMARKS
  std::vector<std::int64_t> sightings;   ///< when LANDMARKS had any, whatever they came of

  std::vector<MapPoint> map_points() const;
};

/// Gathers into `recording`, which must outlive `bus`, what the bus will hand out. Messages with a
/// number that is not finite or an absurd time are left out and counted on the bus.
void gather(Bus& bus, Recording& recording);

/// Trajectories and sightings into order of time. To be called when all is gathered.
void sort_by_time(Recording& recording);

}  // namespace roomwise
