#include "logs/tools/score_map.h"

#include <algorithm>
#include <tuple>

namespace roomwise {
namespace {

constexpr double kFarthestPair_m = 0.5;

struct Candidate {
  double distance_m;
  std::size_t map;
  std::size_t truth;
};

/// Grows a one-to-one matching.
class Matcher {
 public:
  Matcher(const std::vector<MapPoint>& map, const std::vector<MapPoint>& truth)
      : map_(map), truth_(truth), map_taken_(map.size()), truth_taken_(truth.size()) {}

  void match_identities() {
    for (std::size_t i = 0; i < map_.size(); ++i) {
      if (map_[i].identity < 0) continue;
      const auto same = std::ranges::find(truth_, map_[i].identity, &MapPoint::identity);
      if (same != truth_.end()) take(i, static_cast<std::size_t>(same - truth_.begin()));
    }
  }

  void match_nearest(const Pose2& T_world_map) {
    std::vector<Candidate> candidates = close_pairs(T_world_map);
    std::ranges::sort(candidates, {}, [](const Candidate& pair) {
      return std::tuple(pair.distance_m, pair.map, pair.truth);
    });
    for (const Candidate& pair : candidates) take(pair.map, pair.truth);
  }

  MatchedMap matched() const { return matched_; }

 private:
  std::vector<Candidate> close_pairs(const Pose2& T_world_map) const {
    std::vector<Candidate> pairs;
    for (std::size_t i = 0; i < map_.size(); ++i) {
      if (map_[i].identity >= 0) continue;
      const Eigen::Vector2d p_m = transform(T_world_map, map_[i].p_m);
      for (std::size_t k = 0; k < truth_.size(); ++k) {
        const double distance_m = (truth_[k].p_m - p_m).norm();
        if (distance_m <= kFarthestPair_m) pairs.push_back({distance_m, i, k});
      }
    }
    return pairs;
  }

  void take(std::size_t i, std::size_t k) {
    if (map_taken_[i] || truth_taken_[k]) return;
    map_taken_[i] = true;
    truth_taken_[k] = true;
    matched_.p_map_m.push_back(map_[i].p_m);
    matched_.p_world_m.push_back(truth_[k].p_m);
  }

  const std::vector<MapPoint>& map_;
  const std::vector<MapPoint>& truth_;
  std::vector<bool> map_taken_;
  std::vector<bool> truth_taken_;
  MatchedMap matched_;
};

}  // namespace

MatchedMap match_map(const std::vector<MapPoint>& map, const std::vector<MapPoint>& truth,
                     const Pose2& T_world_map) {
  Matcher matcher(map, truth);
  matcher.match_identities();
  matcher.match_nearest(T_world_map);
  return matcher.matched();
}

std::optional<MapScore> score_map(const MatchedMap& matched, const Pose2& T_world_map_raw) {
  if (matched.p_map_m.empty()) return std::nullopt;
  const Pose2 aligned = align_rigidly(matched.p_map_m, matched.p_world_m);
  return MapScore{matched.p_map_m.size(),
                  rms_distance_m(T_world_map_raw, matched.p_map_m, matched.p_world_m),
                  rms_distance_m(aligned, matched.p_map_m, matched.p_world_m)};
}

}  // namespace roomwise
