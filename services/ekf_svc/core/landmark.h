#pragma once
#include <cstdint>
#include <limits>

#include "common/geometry/pose2.h"

namespace roomwise::ekf {

/// Colour of a landmark's near surface: ln(R/G), ln(B/G) and the variance of each.
struct Signature {
  double red_log = 0.0;
  double blue_log = 0.0;
  double variance_log2 = 1e6;  ///< very large: no colour
};

/// How far beyond its place in the map (negative: short of it) a landmark was seen last.
struct RangeOff {
  double off_m = 0.0;
  double travel_m = -std::numeric_limits<double>::infinity();  ///< way the robot had gone then
};

/// What the map knows of a landmark beside its place.
struct Landmark {
  std::int64_t map_id = 0;     ///< never used twice; 0: tentative
  std::int32_t identity = -1;  ///< >= 0: known for certain; -1: unknown
  std::int8_t kind = 0;        ///< landmark_observation_t.KIND_*
  Signature signature = {};
  std::int32_t times_seen = 0;
  std::int32_t refusals = 0;         ///< gate refusals in a row
  std::int32_t score = 0;            ///< sightings less the times it was looked through
  double first_seen_travel_m = 0.0;  ///< way the robot had gone then
  double last_seen_travel_m = 0.0;
  RangeOff range_off = {};
  /// Direction from the robot in the map frame when first seen; not a number: not known.
  double first_sight_rad = std::numeric_limits<double>::quiet_NaN();
  bool is_tentative = false;   ///< seen, but not sure enough to be in the map
  Pose2 first_seen_from = {};  ///< of a tentative one
};

}  // namespace roomwise::ekf
