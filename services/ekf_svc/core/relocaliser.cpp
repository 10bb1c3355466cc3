#include "services/ekf_svc/core/relocaliser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/ekf_svc/core/chi_square.h"

namespace roomwise::ekf {
namespace {

constexpr std::int32_t kSureTimesSeenMin = 5;
constexpr std::size_t kSureMax = 24;       // local landmarks compared
constexpr std::size_t kAnchorsMax = 40;    // pairs of them that propose
constexpr double kProposalReach_m = 0.25;  // proposals come from two landmarks only
constexpr double kFitReach_m = 0.15;
constexpr double kAnchorMin_m = 1.0;  // nearer pairs say little about the heading
constexpr std::size_t kRivalMargin = 2;
constexpr double kFittingShareMin = 0.8;
constexpr double kOtherPlace_m = 0.4;  // proposals nearer to each other are of the same place
constexpr double kOtherPlace_rad = 0.3;
constexpr std::size_t kNoLandmark = std::numeric_limits<std::size_t>::max();

std::vector<std::size_t> sure_landmarks(const MapSnapshot& local) {
  std::vector<std::size_t> sure;
  for (std::size_t l = 0; l < local.landmarks.size(); ++l) {
    const Landmark& landmark = local.landmarks[l];
    if (landmark.identity < 0 && landmark.times_seen >= kSureTimesSeenMin) sure.push_back(l);
  }
  std::stable_sort(sure.begin(), sure.end(), [&](std::size_t a, std::size_t b) {
    return local.landmarks[a].times_seen > local.landmarks[b].times_seen;
  });
  sure.resize(std::min(sure.size(), kSureMax));
  return sure;
}

/// The motion that brings `from` onto `to`: middle onto middle, direction onto direction.
Pose2 motion_between(const Eigen::Vector2d& from_a, const Eigen::Vector2d& from_b,
                     const Eigen::Vector2d& to_a, const Eigen::Vector2d& to_b) {
  const Eigen::Vector2d from = from_b - from_a, to = to_b - to_a;
  const double heading = std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x());
  const Eigen::Vector2d p = 0.5 * (to_a + to_b) - rotation2(heading) * (0.5 * (from_a + from_b));
  return {p.x(), p.y(), wrap_angle(heading)};
}

/// Apart where it matters: at the local map's middle.
bool is_other_place(const Pose2& a, const Pose2& b, const Eigen::Vector2d& p_local_m) {
  return (transform(a, p_local_m) - transform(b, p_local_m)).norm() > kOtherPlace_m ||
         std::abs(wrap_angle(a.heading_rad - b.heading_rad)) > kOtherPlace_rad;
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

std::vector<LandmarkPair> Relocaliser::pair_up(const MapSnapshot& local,
                                               const std::vector<std::size_t>& sure,
                                               const Pose2& T_map_local, double reach_m) const {
  std::vector<LandmarkPair> pairs;
  for (const std::size_t a : sure) {
    const std::size_t b =
        nearest(transform(T_map_local, local.positions_m[a]), local.landmarks[a], reach_m);
    const bool is_free = std::none_of(pairs.begin(), pairs.end(),
                                      [=](const LandmarkPair& pair) { return pair.old == b; });
    if (b != kNoLandmark && is_free) pairs.push_back({a, b});
  }
  return pairs;
}

std::vector<Pose2> Relocaliser::propose(const MapSnapshot& local,
                                        const std::vector<std::size_t>& sure) const {
  std::vector<Pose2> proposals;
  std::size_t anchors = 0;
  for (std::size_t i = 0; i < sure.size(); ++i) {
    for (std::size_t j = i + 1; j < sure.size(); ++j) {
      const Eigen::Vector2d& a = local.positions_m[sure[i]];
      const Eigen::Vector2d& b = local.positions_m[sure[j]];
      const double distance_m = (a - b).norm();
      if (distance_m < kAnchorMin_m || distance_m > MapPairIndex::kDistanceMax_m) continue;
      if (++anchors > kAnchorsMax) return proposals;
      for (const int shift : {-1, 0, 1}) {
        for (const MapPairIndex::Pair& pair : index_.find(distance_m, local.landmarks[sure[i]].kind,
                                                          local.landmarks[sure[j]].kind, shift)) {
          proposals.push_back(
              motion_between(a, b, map_.positions_m[pair.first], map_.positions_m[pair.second]));
        }
      }
    }
  }
  return proposals;
}

/// The proposal made exact, with the pairs that fit it jointly.
std::optional<Relocaliser::Place> Relocaliser::judge(const MapSnapshot& local,
                                                     const std::vector<std::size_t>& sure,
                                                     const Pose2& proposal,
                                                     std::size_t enough) const {
  const auto rough = pair_up(local, sure, proposal, kProposalReach_m);
  if (rough.size() + kRivalMargin < enough) return std::nullopt;
  const Pose2 refined = fit_constellation(map_, local, rough, proposal).T_map_local;
  Place place{.fit = {.T_map_local = refined}, .pairs = pair_up(local, sure, refined, kFitReach_m)};
  auto& [fit, pairs] = place;
  while (pairs.size() >= 3) {
    fit = fit_constellation(map_, local, pairs, fit.T_map_local);
    const int freedom = 2 * static_cast<int>(pairs.size()) - 3;
    if (fit.squared < chi_square_quantile(freedom, kNormal95)) return place;
    drop_worst(local, place);
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

std::optional<Relocaliser::Place> Relocaliser::find(const MapSnapshot& local) const {
  const std::vector<std::size_t> sure = sure_landmarks(local);
  if (sure.size() < kPairsMin) return std::nullopt;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const std::size_t l : sure) {
    middle += local.positions_m[l] / static_cast<double>(sure.size());
  }
  const auto enough = std::max(
      kPairsMin,
      static_cast<std::size_t>(std::ceil(kFittingShareMin * static_cast<double>(sure.size()))));

  std::optional<Place> best;
  std::size_t rival_pairs = 0;
  for (const Pose2& proposal : propose(local, sure)) {
    if (best && !is_other_place(proposal, best->fit.T_map_local, middle)) continue;
    auto place = judge(local, sure, proposal, enough);
    if (!place) continue;
    if (best && !is_other_place(place->fit.T_map_local, best->fit.T_map_local, middle)) continue;
    const std::size_t best_pairs = best ? best->pairs.size() : 0;
    if (place->pairs.size() < enough || place->pairs.size() <= best_pairs) {
      rival_pairs = std::max(rival_pairs, place->pairs.size());
      continue;
    }
    rival_pairs = std::max(rival_pairs, best_pairs);
    best = std::move(place);
  }
  if (!best || rival_pairs + kRivalMargin > best->pairs.size()) return std::nullopt;
  return best;
}

}  // namespace roomwise::ekf
