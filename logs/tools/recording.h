#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "logs/tools/score_map.h"
#include "logs/tools/trajectory.h"
#include "roomwise/landmark_map_t.hpp"

namespace roomwise {

class Bus;

/// What a log says of where the robot and the landmarks are.
struct Recording {
  Trajectory poses;                      ///< POSE
  Trajectory odometry;                   ///< ODOMETRY
  Trajectory truth;                      ///< TRUTH
  std::vector<MapPoint> true_landmarks;  ///< the newest list that was not empty
  std::optional<landmark_map_t> map;     ///< the last
  std::int64_t landmark_frames = 0;      ///< LANDMARKS messages that came of a camera frame
  std::int64_t landmarks_in_frames = 0;  ///< and the landmarks in them

  std::vector<MapPoint> map_points() const;
};

/// Gathers into `recording`, which must outlive `bus`, what the bus will hand out. Messages with a
/// number that is not finite or an absurd time are left out and counted on the bus.
void gather(Bus& bus, Recording& recording);

/// Trajectories into order of time. To be called when all is gathered.
void sort_by_time(Recording& recording);

}  // namespace roomwise
