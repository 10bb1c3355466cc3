#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "logs/tools/recording.h"

namespace roomwise {

/// A sighting that was matched to what it shows.
struct LandmarkMatch {
  std::size_t truth = 0;   ///< index into Recording::true_landmarks
  std::int8_t kind = 0;    ///< as it was called
  std::int64_t utime = 0;  ///< of the frame
  double range_m = 0.0;
  Eigen::Vector2d p_robot_m;  ///< where the robot truly was, world frame
  Eigen::Vector2d error_m;    ///< of the landmark's place, world frame
};

/// Sightings of one kind.
struct LandmarkCounts {
  std::size_t seen = 0;
  std::size_t matched = 0;
  double precision_ratio() const;  ///< 0 if none was seen
};

/// How the sightings of a drive compare with the truth. Those marked moving are left out.
struct LandmarkScore {
  std::size_t frames = 0;
  std::size_t seen = 0;                ///< at rest, frame by frame
  std::size_t moving = 0;              ///< marked as moving
  std::size_t in_sight = 0;            ///< true ones, frame by frame
  std::size_t found = 0;               ///< of those
  std::vector<LandmarkMatch> matches;  ///< in order of time; the rest of `seen` is false

  std::map<std::int8_t, LandmarkCounts> by_kind;

  LandmarkCounts of_kind(std::int8_t kind) const;
  double precision_ratio() const;
  double found_ratio() const;  ///< of what is in sight
  double false_per_frame() const;
  double error_rms_m() const;
  /// Scatter of one sighting from `least_m` to `most_m` away: RMS of the difference between two
  /// sightings of one thing at most 0.15 s apart, over the root of 2. 0 if there are none.
  double repeat_std_m(double least_m, double most_m) const;
  /// Median distance between the places one thing was seen at, of one kind, from viewpoints at
  /// least 0.5 m apart (each sighting with the first as far away). 0 if there are none.
  double viewpoint_median_m() const;
};

/// Matches each sighting to the nearest true landmark it may be: within 0.1 m + 2 % of its range,
/// and of a fitting kind. A corner that protrudes shows as an edge on either side from where one
/// face is in view, as a convex crease from where both are; an edge may also be a pole's whose
/// other side is hidden; a pole may be a thin board of something larger. A true landmark is in
/// sight where the frame's virtual scan comes within 5 cm of it, in the range looked at, and found
/// if a sighting was matched to it: of corners close together, the one of a door's frame and the
/// one of its leaf, one sighting finds one. Frames without a true pose are left out.
LandmarkScore score_landmarks(const Recording& recording);

}  // namespace roomwise
