#include "services/ekf_svc/core/relocaliser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/ekf_svc/core/chi_square.h"

namespace roomwise::ekf {
namespace {

constexpr std::size_t kChosenMax = 24;     // local landmarks compared
constexpr std::size_t kAnchorsMax = 40;    // pairs of them that propose
constexpr double kProposalReach_m = 0.25;  // proposals come from two landmarks only
constexpr double kFitReach_m = 0.15;
constexpr double kAnchorMin_m = 1.0;  // nearer pairs say little about the heading
constexpr double kFittingShareMin = 0.8;
constexpr double kOtherPlace_m = 0.4;  // proposals nearer to each other are of the same place
constexpr double kOtherPlace_rad = 0.3;
constexpr double kSameProposal_m = 0.08;  // ... and of the same pairs
constexpr double kSameProposal_rad = 0.05;
constexpr std::size_t kNoLandmark = std::numeric_limits<std::size_t>::max();

// Landmarks the saved map lacks: where there are two on a square metre, one in five is new or was
// moved, against the four that are found again.
constexpr double kUnknownDensity_per_m2 = 2.0 * 0.2 / 0.8;
constexpr double kEvidenceMargin = 13.8;  // ln of a million
// A rival with fewer pairs yet is far less likely: each pair weighs 3 and more, if it fits at all.
constexpr std::size_t kRivalPairsLess = 2;

/// The motion that brings `from` onto `to`: middle onto middle, direction onto direction.
Pose2 motion_between(const Eigen::Vector2d& from_a, const Eigen::Vector2d& from_b,
                     const Eigen::Vector2d& to_a, const Eigen::Vector2d& to_b) {
  const Eigen::Vector2d from = from_b - from_a, to = to_b - to_a;
  const double heading = std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x());
  const Eigen::Vector2d p = 0.5 * (to_a + to_b) - rotation2(heading) * (0.5 * (from_a + from_b));
  return {p.x(), p.y(), wrap_angle(heading)};
}

}  // namespace

Relocaliser::Relocaliser(MapSnapshot map) : map_(std::move(map)), index_(map_) {
  for (std::size_t l = 0; l < map_.landmarks.size(); ++l) by_x_.push_back(l);
  std::sort(by_x_.begin(), by_x_.end(), [this](std::size_t a, std::size_t b) {
    return map_.positions_m[a].x() < map_.positions_m[b].x();
  });
}

std::size_t Relocaliser::nearest(const Eigen::Vector2d& p_map_m, const Landmark& like,
                                 double reach_m) const {
  std::size_t best = kNoLandmark;
  double best_m2 = reach_m * reach_m;
  auto at =
      std::lower_bound(by_x_.begin(), by_x_.end(), p_map_m.x() - reach_m,
                       [this](std::size_t l, double x_m) { return map_.positions_m[l].x() < x_m; });
  for (; at != by_x_.end() && map_.positions_m[*at].x() < p_map_m.x() + reach_m; ++at) {
    const Landmark& landmark = map_.landmarks[*at];
    if (landmark.kind != like.kind || landmark.identity >= 0) continue;
    const double distance_m2 = (map_.positions_m[*at] - p_map_m).squaredNorm();
    if (distance_m2 >= best_m2) continue;
    best = *at;
    best_m2 = distance_m2;
  }
  return best;
}

/// The landmarks compared: those seen most, if there are more than can be. A landmark is as sure as
/// its covariance says, so that few sightings need no rule of their own.
Relocaliser::Local Relocaliser::choose(const MapSnapshot& map) {
  Local local{.map = map, .chosen = {}, .middle_m = Eigen::Vector2d::Zero(), .enough = kPairsMin};
  for (std::size_t l = 0; l < map.landmarks.size(); ++l) {
    if (map.landmarks[l].identity < 0) local.chosen.push_back(l);
  }
  std::stable_sort(local.chosen.begin(), local.chosen.end(), [&](std::size_t a, std::size_t b) {
    return map.landmarks[a].times_seen > map.landmarks[b].times_seen;
  });
  local.chosen.resize(std::min(local.chosen.size(), kChosenMax));
  const auto count = static_cast<double>(local.chosen.size());
  for (const std::size_t l : local.chosen) local.middle_m += map.positions_m[l] / count;
  local.enough = std::max(kPairsMin, static_cast<std::size_t>(std::ceil(kFittingShareMin * count)));
  return local;
}

/// Judged where it matters: where the local map's middle comes to lie.
Relocaliser::Lying Relocaliser::how_it_lies(const Local& local, const Pose2& T_map_local) {
  return {transform(T_map_local, local.middle_m), T_map_local.heading_rad};
}

bool Relocaliser::Lying::is_near(const Lying& other, double reach_m, double reach_rad) const {
  return (middle_map_m - other.middle_map_m).squaredNorm() <= reach_m * reach_m &&
         std::abs(wrap_angle(heading_rad - other.heading_rad)) <= reach_rad;
}

std::vector<LandmarkPair> Relocaliser::pair_up(const Local& local, const Pose2& T_map_local,
                                               double reach_m) const {
  std::vector<LandmarkPair> pairs;
  for (const std::size_t a : local.chosen) {
    const std::size_t b =
        nearest(transform(T_map_local, local.map.positions_m[a]), local.map.landmarks[a], reach_m);
    const bool is_free = std::none_of(pairs.begin(), pairs.end(),
                                      [=](const LandmarkPair& pair) { return pair.old == b; });
    if (b != kNoLandmark && is_free) pairs.push_back({a, b});
  }
  return pairs;
}

std::vector<Pose2> Relocaliser::propose(const Local& local) const {
  const auto& [map, chosen, middle_m, enough] = local;
  std::vector<Pose2> proposals;
  std::size_t anchors = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = i + 1; j < chosen.size(); ++j) {
      const Eigen::Vector2d& a = map.positions_m[chosen[i]];
      const Eigen::Vector2d& b = map.positions_m[chosen[j]];
      const double distance_m = (a - b).norm();
      if (distance_m < kAnchorMin_m || distance_m > MapPairIndex::kDistanceMax_m) continue;
      if (++anchors > kAnchorsMax) return proposals;
      for (const int shift : {-1, 0, 1}) {
        for (const MapPairIndex::Pair& pair : index_.find(distance_m, map.landmarks[chosen[i]].kind,
                                                          map.landmarks[chosen[j]].kind, shift)) {
          proposals.push_back(
              motion_between(a, b, map_.positions_m[pair.first], map_.positions_m[pair.second]));
        }
      }
    }
  }
  return proposals;
}

/// The proposal made exact, with the pairs that fit it jointly.
std::optional<Relocaliser::Place> Relocaliser::judge(const Local& local, const Pose2& proposal,
                                                     std::vector<LandmarkPair> rough) const {
  const Pose2 refined = fit_constellation(map_, local.map, rough, proposal).T_map_local;
  Place place;
  place.pairs = pair_up(local, refined, kFitReach_m);
  place.fit.T_map_local = refined;
  auto& [fit, pairs, log_evidence, lies] = place;
  while (pairs.size() + kRivalPairsLess >= local.enough) {
    fit = fit_constellation(map_, local.map, pairs, fit.T_map_local);
    const int freedom = 2 * static_cast<int>(pairs.size()) - 3;
    const auto unknown = static_cast<double>(local.chosen.size() - pairs.size());
    log_evidence = fit.log_density + unknown * std::log(kUnknownDensity_per_m2);
    if (fit.squared < chi_square_quantile(freedom, kNormal95)) {
      lies = how_it_lies(local, fit.T_map_local);
      return place;
    }
    drop_worst(local.map, place);
  }
  return std::nullopt;
}

void Relocaliser::drop_worst(const MapSnapshot& local, Place& place) const {
  const auto error_m2 = [&](const LandmarkPair& pair) {
    return (map_.positions_m[pair.old] -
            transform(place.fit.T_map_local, local.positions_m[pair.recent]))
        .squaredNorm();
  };
  place.pairs.erase(std::max_element(
      place.pairs.begin(), place.pairs.end(),
      [&](const LandmarkPair& a, const LandmarkPair& b) { return error_m2(a) < error_m2(b); }));
}

/// Every place that enough landmarks fit to be a rival at least, each once.
std::vector<Relocaliser::Place> Relocaliser::places(const Local& local) const {
  std::vector<Place> found;
  std::vector<Lying> tried;
  for (const Pose2& proposal : propose(local)) {
    auto rough = pair_up(local, proposal, kProposalReach_m);
    if (rough.size() + kRivalPairsLess < local.enough) continue;
    const Lying proposed = how_it_lies(local, proposal);
    const bool is_tried = std::any_of(tried.begin(), tried.end(), [&](const Lying& other) {
      return proposed.is_near(other, kSameProposal_m, kSameProposal_rad);
    });
    if (is_tried) continue;
    tried.push_back(proposed);
    auto place = judge(local, proposal, std::move(rough));
    if (!place) continue;
    const auto same = std::find_if(found.begin(), found.end(), [&](const Place& other) {
      return place->lying.is_near(other.lying, kOtherPlace_m, kOtherPlace_rad);
    });
    if (same == found.end()) {
      found.push_back(std::move(*place));
    } else if (place->log_evidence > same->log_evidence) {
      *same = std::move(*place);
    }
  }
  return found;
}

std::optional<Relocaliser::Place> Relocaliser::find(const MapSnapshot& map) const {
  const Local local = choose(map);
  if (local.chosen.size() < kPairsMin) return std::nullopt;
  std::vector<Place> found = places(local);
  const auto is_less_likely = [](const Place& a, const Place& b) {
    return a.log_evidence < b.log_evidence;
  };
  const auto best = std::max_element(found.begin(), found.end(), is_less_likely);
  if (best == found.end() || best->pairs.size() < local.enough) return std::nullopt;
  const bool stands_out = std::all_of(found.begin(), found.end(), [&](const Place& place) {
    return &place == &*best || place.log_evidence + kEvidenceMargin <= best->log_evidence;
  });
  return stands_out ? std::optional(std::move(*best)) : std::nullopt;
}

}  // namespace roomwise::ekf
