#pragma once
#include <optional>
#include <vector>

#include "services/ekf_svc/core/constellation_fit.h"
#include "services/ekf_svc/core/map_pair_index.h"

namespace roomwise::ekf {

/// Finds where a small map, made since the robot woke up or got lost, lies in a large one, from
/// nothing but the landmarks: pairs of both maps that are as far apart propose rigid motions, and
/// each is judged by its evidence: how likely the local landmarks are if this is the place, those
/// that have no counterpart in the saved map included. The best is accepted only if
///   at least kPairsMin pairs and 80 % of the local landmarks fit, jointly (95 %),
///   and every other place or heading is a million times less likely.
/// Where landmarks stand in a row, many places fit nearly as well, and by their number of pairs
/// alone cannot be told from the right one; by how well they fit they can. A place that is not in
/// the map fits many places equally badly: none of them stands out.
/// Rather lost than wrong: a refusal costs another metre of driving.
class Relocaliser {
 public:
  explicit Relocaliser(MapSnapshot map);

  /// How the local map lies in the saved one.
  struct Lying {
    Eigen::Vector2d middle_map_m = Eigen::Vector2d::Zero();  ///< of its landmarks
    double heading_rad = 0.0;
    bool is_near(const Lying& other, double reach_m, double reach_rad) const;
  };
  struct Place {
    ConstellationFit fit;
    std::vector<LandmarkPair> pairs;  ///< recent: of the local map; old: of the saved one
    double log_evidence = 0.0;        ///< natural logarithm; only differences have a meaning
    Lying lying;
  };
  /// `local` in its own frame. Empty: not sure yet.
  std::optional<Place> find(const MapSnapshot& local) const;

  const MapSnapshot& map() const { return map_; }

  static constexpr std::size_t kPairsMin = 6;

 private:
  /// The local landmarks compared, and where they are.
  struct Local {
    const MapSnapshot& map;
    std::vector<std::size_t> chosen;
    Eigen::Vector2d middle_m;
    std::size_t enough;  // pairs
  };
  static Local choose(const MapSnapshot& local);
  static Lying how_it_lies(const Local& local, const Pose2& T_map_local);

  std::vector<Pose2> propose(const Local& local) const;
  std::vector<Place> places(const Local& local) const;
  std::optional<Place> judge(const Local& local, const Pose2& proposal,
                             std::vector<LandmarkPair> rough) const;
  void drop_worst(const MapSnapshot& local, Place& place) const;
  std::vector<LandmarkPair> pair_up(const Local& local, const Pose2& T_map_local,
                                    double reach_m) const;
  std::size_t nearest(const Eigen::Vector2d& p_map_m, const Landmark& like, double reach_m) const;

  MapSnapshot map_;
  MapPairIndex index_;
  std::vector<std::size_t> by_x_;  // landmarks in order of x
};

}  // namespace roomwise::ekf
