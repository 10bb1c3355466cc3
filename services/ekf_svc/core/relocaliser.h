#pragma once
#include <optional>
#include <vector>

#include "services/ekf_svc/core/constellation_fit.h"
#include "services/ekf_svc/core/map_pair_index.h"

namespace roomwise::ekf {

/// Finds where a small map, made since the robot woke up or got lost, lies in a large one, from
/// nothing but the landmarks: pairs of both maps that are as far apart propose rigid motions, each
/// is judged by how many landmarks it brings together, and the best is accepted only if
///   at least kPairsMin pairs and 80 % of the local landmarks fit, jointly (95 %),
///   and every other place or heading brings together two pairs less.
/// Rather lost than wrong: a refusal costs another metre of driving.
class Relocaliser {
 public:
  explicit Relocaliser(MapSnapshot map);

  struct Place {
    ConstellationFit fit;
    std::vector<LandmarkPair> pairs;  ///< recent: of the local map; old: of the saved one
  };
  /// `local` in its own frame. Empty: not sure yet.
  std::optional<Place> find(const MapSnapshot& local) const;

  const MapSnapshot& map() const { return map_; }

  static constexpr std::size_t kPairsMin = 6;

 private:
  std::vector<Pose2> propose(const MapSnapshot& local, const std::vector<std::size_t>& sure) const;
  std::optional<Place> judge(const MapSnapshot& local, const std::vector<std::size_t>& sure,
                             const Pose2& proposal, std::size_t enough) const;
  void drop_worst(const MapSnapshot& local, Place& place) const;
  std::vector<LandmarkPair> pair_up(const MapSnapshot& local, const std::vector<std::size_t>& sure,
                                    const Pose2& T_map_local, double reach_m) const;
  std::size_t nearest(const Eigen::Vector2d& p_map_m, const Landmark& like, double reach_m) const;

  MapSnapshot map_;
  MapPairIndex index_;
  std::vector<std::size_t> by_x_;  // landmarks in order of x
};

}  // namespace roomwise::ekf
