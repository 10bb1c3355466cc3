#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "logs/tools/alignment.h"

namespace roomwise {

/// A landmark as a map or the truth has it.
struct MapPoint {
  std::int32_t identity = -1;  ///< -1: unknown
  Eigen::Vector2d p_m{0.0, 0.0};
  std::int8_t kind = 0;  ///< landmark_observation_t::KIND_*
};

/// Landmarks that are the same thing: their places in the map and in the world. Same length.
struct MatchedMap {
  Points2 p_map_m;
  Points2 p_world_m;
};

/// Matches landmarks of one identity; then those whose identity is unknown to the nearest that is
/// left after `T_world_map`, the closest pair first, no farther apart than 0.5 m. One to one.
MatchedMap match_map(const std::vector<MapPoint>& map, const std::vector<MapPoint>& truth,
                     const Pose2& T_world_map);

struct MapScore {
  std::size_t matched = 0;
  double map_raw_m = 0.0;      ///< RMS error, the map placed by T_world_map_raw
  double map_aligned_m = 0.0;  ///< RMS error after the map's own best rigid alignment
};

/// None if nothing matched.
std::optional<MapScore> score_map(const MatchedMap& matched, const Pose2& T_world_map_raw);

}  // namespace roomwise
