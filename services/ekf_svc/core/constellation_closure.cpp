#include "services/ekf_svc/core/constellation_closure.h"

#include <algorithm>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/chi_square.h"

namespace roomwise::ekf {
namespace {

constexpr double kRecentTravel_m = 4.0;  // A: seen within
constexpr double kYoungTravel_m = 12.0;  // ... and begun within
constexpr double kOldTravel_m = 12.0;    // B: not seen for
constexpr std::int32_t kTimesSeenMin = 5;
constexpr std::size_t kRecentMax = 14;
constexpr double kShareMin = 0.6;
constexpr double kRivalSqMin = 16.0;  // a rival of a pair must be worse than the 99.97 % quantile
constexpr JointCompatibility::Limits kLimits{.normal_quantile = kNormal95, .nodes = 3000};

}  // namespace

bool may_be_one(const Landmark& recent, const Landmark& old) {
  if (recent.identity >= 0 || old.identity >= 0 || recent.kind != old.kind) return false;
  if (old.last_seen_travel_m >= recent.first_seen_travel_m) return false;
  const SignatureDistance colour = distance(recent.signature, old.signature);
  return colour.degrees_of_freedom == 0 ||
         colour.squared < chi_square_quantile(colour.degrees_of_freedom, kNormal99);
}

ConstellationClosure::ConstellationClosure(const SlamFilter& filter)
    : filter_(&filter), joint_(filter), gate_(filter) {
  recent_.reserve(filter.landmark_budget());
  old_.reserve(filter.landmark_budget());
  accepted_.reserve(kRecentMax);
  pairs_.reserve(kRecentMax);
}

std::span<const LandmarkPair> ConstellationClosure::find(double travel_m) {
  pairs_.clear();
  accepted_.clear();
  collect(travel_m);
  if (recent_.size() < kPairsMin || old_.size() < kPairsMin) return {};
  offer_pairings();
  const JointCompatibility::Answer& answer = joint_.search(kLimits);
  const double share = static_cast<double>(answer.pairs) / static_cast<double>(recent_.size());
  if (!answer.is_complete || answer.pairs < kPairsMin || share < kShareMin) return {};
  for (std::size_t a = 0; a < recent_.size(); ++a) {
    if (answer.chosen[a] == nullptr) continue;
    accepted_.push_back(*answer.chosen[a]);
    pairs_.push_back({recent_[a], answer.chosen[a]->target});
  }
  if (has_rival(pairs_.size())) return {};
  keep_sure_pairs();
  return pairs_.size() >= kPairsMin ? std::span<const LandmarkPair>(pairs_)
                                    : std::span<const LandmarkPair>{};
}

void ConstellationClosure::collect(double travel_m) {
  recent_.clear();
  old_.clear();
  for (std::size_t l = 0; l < filter_->landmark_count(); ++l) {
    const Landmark& landmark = filter_->landmark(l);
    if (landmark.identity >= 0 || landmark.is_tentative) continue;
    if (landmark.times_seen < kTimesSeenMin) continue;
    const double unseen_m = travel_m - landmark.last_seen_travel_m;
    const bool is_young = travel_m - landmark.first_seen_travel_m <= kYoungTravel_m;
    if (is_young && unseen_m <= kRecentTravel_m) recent_.push_back(l);
    if (unseen_m >= kOldTravel_m) old_.push_back(l);
  }
  std::sort(recent_.begin(), recent_.end(), [this](std::size_t a, std::size_t b) {
    const double seen_a = filter_->landmark(a).last_seen_travel_m;
    const double seen_b = filter_->landmark(b).last_seen_travel_m;
    return seen_a != seen_b ? seen_a > seen_b : a < b;
  });
  recent_.resize(std::min(recent_.size(), kRecentMax));
}

void ConstellationClosure::offer_pairings() {
  joint_.clear();
  for (const std::size_t a : recent_) {
    joint_.begin_observation();
    for (const std::size_t b : old_) {
      if (!may_be_one(filter_->landmark(a), filter_->landmark(b))) continue;
      const Residual residual = filter_->equality_residual(a, b, kSigma_m);
      const double squared =
          mahalanobis_sq(residual.innovation, filter_->innovation_covariance(residual));
      if (squared >= chi_square_quantile(2, kNormal99)) continue;
      joint_.add({residual, b, {}, squared});
    }
  }
}

/// True if nearly as many pairs fit when every chosen one is left out: a corridor that repeats.
bool ConstellationClosure::has_rival(std::size_t pairs) {
  for (std::size_t a = 0; a < recent_.size(); ++a) {
    for (const LandmarkPair& pair : pairs_) {
      if (pair.recent == recent_[a]) joint_.forbid(a, pair.old);
    }
  }
  const JointCompatibility::Answer& rival = joint_.search(kLimits);
  return !rival.is_complete || rival.pairs + 2 > pairs;
}

/// Leaves out, worst first, the pairs that do not fit the others or might be others.
void ConstellationClosure::keep_sure_pairs() {
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    if (pairs_.size() < kPairsMin) return;
    if (is_sure(i)) continue;
    pairs_.erase(pairs_.begin() + static_cast<std::ptrdiff_t>(i));
    accepted_.erase(accepted_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

bool ConstellationClosure::is_sure(std::size_t pair) {
  gate_.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (i != pair) static_cast<void>(gate_.push(accepted_[i].residual));
  }
  if (gate_.cost(accepted_[pair].residual) >= chi_square_quantile(2, kNormal99)) return false;
  const std::size_t recent = pairs_[pair].recent;
  const std::size_t old = pairs_[pair].old;
  const auto rivals = [&](std::size_t other_recent, std::size_t other_old) {
    if (!may_be_one(filter_->landmark(other_recent), filter_->landmark(other_old))) return false;
    const Residual residual = filter_->equality_residual(other_recent, other_old, kSigma_m);
    return gate_.cost(residual) < kRivalSqMin;
  };
  return std::none_of(old_.begin(), old_.end(),
                      [&](std::size_t b) { return b != old && rivals(recent, b); }) &&
         std::none_of(recent_.begin(), recent_.end(),
                      [&](std::size_t a) { return a != recent && rivals(a, old); });
}

}  // namespace roomwise::ekf
