#include "services/ekf_svc/core/local_association.h"

#include <algorithm>

#include "services/ekf_svc/core/arc_innovation.h"
#include "services/ekf_svc/core/chi_square.h"
#include "services/ekf_svc/core/outline.h"

namespace roomwise::ekf {
namespace {

constexpr double kLocalReach_m = 15.0;           // farther landmarks are never in view
constexpr double kSigmaPerSpacing = 1.0 / 10.0;  // 5 sigma reach half way to the next
constexpr double kWellKnownSigmaMax_m = 0.5;
constexpr double kToldApartSq = 4.0;  // of distance to noise of one sighting, 2 sigma
constexpr JointCompatibility::Limits kLocalLimits{.normal_quantile = kNormal99, .nodes = 3000};

}  // namespace

LocalAssociation::LocalAssociation(const SlamFilter& filter) : filter_(&filter), joint_(filter) {
  locals_.reserve(filter.landmark_budget());
  offers_.reserve(256);
  candidates_.reserve(1024);
  is_taken_.resize(filter.landmark_budget());
}

void LocalAssociation::begin(double travel_m) {
  travel_m_ = travel_m;
  locals_.clear();
  offers_.clear();
  candidates_.clear();
  joint_.clear();
  const RobotMatrix P = filter_->robot_covariance();
  const double range_variance = 2.0 * P.bottomRightCorner<2, 2>().trace();
  const Eigen::Vector2d p_robot_m = filter_->pose().position_m();
  for (std::size_t l = 0; l < filter_->landmark_count(); ++l) {
    const Landmark& landmark = filter_->landmark(l);
    if (landmark.identity >= 0 || landmark.is_tentative) continue;
    const Eigen::Vector2d p_map_m = filter_->landmark_position_m(l);
    const double range_m2 = (p_map_m - p_robot_m).squaredNorm();
    if (range_m2 > kLocalReach_m * kLocalReach_m) continue;
    // cov(a + b + c + d) <= 4 (cov a + cov b + cov c + cov d)
    const double spread_m2 = 4.0 * (range_m2 * (P(0, 0) + range_variance) + P(1, 1) + P(2, 2) +
                                    filter_->landmark_covariance_m2(l).trace());
    const bool is_seen_lately = travel_m - landmark.last_seen_travel_m <= kLocalTravel_m;
    locals_.push_back({l, p_map_m, spread_m2, is_seen_lately});
  }
}

bool LocalAssociation::offer(std::size_t sighting, const Sighting& what,
                             const BodyObservation& seen) {
  const Eigen::Vector2d p_map_m = transform(filter_->pose(), seen.p_robot_m);
  const double noise_m2 = seen.covariance_m2.trace();
  Offer offer{sighting, std::numeric_limits<double>::infinity(), false, candidates_.size()};
  for (const LocalLandmark& local : locals_) {
    if (filter_->landmark(local.index).kind != what.kind) continue;
    const double distance_m2 = (local.p_map_m - p_map_m).squaredNorm();
    if (distance_m2 > kNewLandmarkSq * (noise_m2 + local.spread_m2)) continue;
    const Residual chord = filter_->observation_residual(local.index, seen);
    if (!may_be(filter_->landmark(local.index), range_off(chord, seen, travel_m_))) continue;
    const Residual residual = unrolled(*filter_, chord, seen);
    const Eigen::Matrix2d S = filter_->innovation_covariance(residual);
    const double relative_m2 = S.trace() - residual.noise.trace();
    if (!local.is_seen_lately && !is_well_known(local, 0.5 * relative_m2, noise_m2)) continue;
    const SignatureDistance colour =
        distance(what.signature, filter_->landmark(local.index).signature);
    const double squared = mahalanobis_sq(residual.innovation, S) + colour.squared;
    offer.nearest_sq = std::min(offer.nearest_sq, squared);
    if (squared >= chi_square_quantile(2 + colour.degrees_of_freedom, kNormal99)) continue;
    if (!offer.has_candidates) {
      if (joint_.is_full()) return false;
      joint_.begin_observation();
      offer.has_candidates = true;
    }
    joint_.add({residual, local.index, colour, squared});
    candidates_.push_back(local.index);
  }
  offers_.push_back(offer);
  return true;
}

/// Known so well that no other landmark of the kind could be meant, but those so near it that a
/// sighting with this noise hardly tells them apart, wherever the robot is.
bool LocalAssociation::is_well_known(const LocalLandmark& local, double variance_m2,
                                     double noise_m2) const {
  if (variance_m2 > kWellKnownSigmaMax_m * kWellKnownSigmaMax_m) return false;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  const std::int8_t kind = filter_->landmark(local.index).kind;
  for (const LocalLandmark& other : locals_) {
    if (other.index == local.index || filter_->landmark(other.index).kind != kind) continue;
    const double apart_m2 = (other.p_map_m - local.p_map_m).squaredNorm();
    if (apart_m2 > kToldApartSq * noise_m2) nearest_m2 = std::min(nearest_m2, apart_m2);
  }
  return variance_m2 < kSigmaPerSpacing * kSigmaPerSpacing * nearest_m2;
}

void LocalAssociation::decide(std::span<Verdict> verdicts, std::span<Candidate> candidates) {
  const JointCompatibility::Answer& answer = joint_.search(kLocalLimits);
  std::fill(is_taken_.begin(), is_taken_.end(), false);
  std::size_t observation = 0;
  for (const Offer& offer : offers_) {
    const Pairing* pairing = offer.has_candidates ? answer.chosen[observation++] : nullptr;
    verdicts[offer.sighting] = Verdict::kAmbiguous;
    if (pairing == nullptr) continue;
    verdicts[offer.sighting] = Verdict::kMatched;
    candidates[offer.sighting] = {pairing->target, pairing->squared};
    is_taken_[pairing->target] = true;
  }
  for (std::size_t i = 0; i < offers_.size(); ++i) {
    Verdict& verdict = verdicts[offers_[i].sighting];
    const bool is_new = offers_[i].nearest_sq > kNewLandmarkSq || are_all_taken(i);
    if (verdict == Verdict::kAmbiguous && is_new) verdict = Verdict::kAdded;
  }
}

/// Whether the offer has candidates and each was seen elsewhere in this frame.
bool LocalAssociation::are_all_taken(std::size_t offer) const {
  const std::size_t first = offers_[offer].first_candidate;
  const std::size_t end =
      offer + 1 < offers_.size() ? offers_[offer + 1].first_candidate : candidates_.size();
  return first < end && std::all_of(candidates_.begin() + static_cast<std::ptrdiff_t>(first),
                                    candidates_.begin() + static_cast<std::ptrdiff_t>(end),
                                    [this](std::size_t landmark) { return is_taken_[landmark]; });
}

}  // namespace roomwise::ekf
