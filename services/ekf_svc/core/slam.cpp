#include "services/ekf_svc/core/slam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/ekf_svc/core/outline.h"
#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {
namespace {

constexpr double kClosureEvery_m = 0.5;  // of way

// A read identity is itself evidence. With one misreading in a hundred, spread over a view of 50
// m^2, the right pair stays the likelier one up to d^2 = 2 ln(99 * 50 m^2 / (2 pi sqrt(det S))):
// about 20 for a mapped landmark. Real slips of the wheels reach 20; misreadings in recordings are
// beyond 500.
constexpr double kKnownGateSq = 25.0;
constexpr int kRefusalsMax = 5;  // in a row, of one landmark while others are accepted

// First step of widening; it doubles every time the gate locks the filter out again.
constexpr double kWideningPosition_m = 0.1;
constexpr double kWideningHeading_rad = 0.1;
constexpr double kWideningRatioMax = 32.0;

constexpr double kRangeSigmaRatioMax = 0.2;  // of ranges worth calibrating

constexpr std::int32_t kTimesSeenMax = 1'000'000'000;
constexpr std::size_t kSightingsExpected = 256;  // memory for more is taken when they come

void tally(std::span<const Verdict> verdicts, FrameResult& result) {
  for (const Verdict verdict : verdicts) {
    switch (verdict) {
      case Verdict::kMatched:
        ++result.matched;
        break;
      case Verdict::kAdded:
      case Verdict::kReplaced:
        ++result.added;
        break;
      case Verdict::kHeld:
      case Verdict::kMoving:
      case Verdict::kTentative:
      case Verdict::kMapFixed:
        break;
      default:
        ++result.rejected;
    }
  }
}

}  // namespace

Slam::Slam(const EkfParams& params)
    : params_(params),
      filter_(params.filter == "plain" ? ErrorForm::kPlain : ErrorForm::kInvariant,
              static_cast<std::size_t>(params.landmark_budget)),
      local_(filter_),
      lifecycle_(filter_, params),
      tentative_(filter_),
      closure_(filter_),
      twins_(filter_) {
  free_calibrations();
  candidates_.reserve(kSightingsExpected);
  claimed_by_.resize(filter_.landmark_budget());
  batch_.reserve(SlamFilter::kResidualsMax);
  residuals_.reserve(SlamFilter::kResidualsMax);
  merged_.reserve(2 * SlamFilter::kResidualsMax);
}

void Slam::free_calibrations() {
  if (!params_.self_calibration) return;
  filter_.free_calibration({params_.calibration_sigma_ratio, params_.calibration_sigma_ratio,
                            params_.calibration_sigma_rad_per_m},
                           params_.calibration_sigma_m_per_rad);
  ranges_are_free_ = false;
}

/// A sensor's ranges are no better than it says, so what repeats of their error is not either. The
/// surest sighting of the first frame that shows anything tells how good it says they are; but not
/// an outline, whose noise is that of where a thing ends.
void Slam::free_ranges(std::span<const Sighting> sightings) {
  if (!params_.self_calibration || ranges_are_free_) return;
  double sigma_ratio = std::numeric_limits<double>::infinity();
  for (const Sighting& seen : sightings) {
    if (check(seen) != Verdict::kMatched || is_outline(seen.kind)) continue;
    const PolarObservation& polar = seen.polar;
    sigma_ratio = std::min(sigma_ratio, std::sqrt(polar.covariance(0, 0)) / polar.range_m);
  }
  if (!std::isfinite(sigma_ratio)) return;
  filter_.free_range_calibration(params_.range_calibration_sigmas *
                                 std::min(sigma_ratio, kRangeSigmaRatioMax));
  ranges_are_free_ = true;
}

void Slam::predict(const MotionIncrement& motion) {
  filter_.predict(motion);
  travel_m_ += motion.path_m;
  if (!params_.self_calibration) return;
  const double drift = params_.calibration_drift_ratio * params_.calibration_drift_ratio;
  filter_.drift_calibration(motion.path_m * drift * Eigen::Vector3d(1.0, 1.0, 0.01));
}

FrameResult Slam::process(std::span<const Sighting> sightings, bool may_update,
                          std::span<Verdict> verdicts, const VirtualScan& scan) {
  FrameResult result{.seen = static_cast<int>(sightings.size())};
  candidates_.resize(sightings.size());
  free_ranges(sightings);
  judge_all(sightings, verdicts);
  if (may_update) {
    result.pose_widened = learn_from_refusals(sightings, verdicts);
    update(sightings, verdicts);
  } else {
    std::replace(verdicts.begin(), verdicts.end(), Verdict::kMatched, Verdict::kHeld);
  }
  note_seen(sightings, verdicts);
  if (may_update) remove_what_is_gone(sightings, verdicts, scan);
  replace_refused(sightings, verdicts);
  add_new(sightings, verdicts);
  merge_what_is_one();
  result.merged = static_cast<int>(merged_.size());
  tally(verdicts, result);
  return result;
}

BodyObservation Slam::body(const Sighting& sighting) const {
  BodyObservation seen = to_body(sighting.polar, params_.range_bias_m, params_.lateral_bias_m,
                                 filter_.range_calibration());
  seen.covariance_m2 *= noise_monitor_.ratio();
  return seen;
}

void Slam::judge_all(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  local_.begin(travel_m_);
  for (std::size_t i = 0; i < sightings.size(); ++i) verdicts[i] = judge(i, sightings[i]);
  keep_best_pairs(verdicts);
  local_.decide(verdicts, candidates_);
}

/// Known identities for good; of unknown ones kAdded stands until all are decided together.
Verdict Slam::judge(std::size_t i, const Sighting& sighting) {
  Candidate& candidate = candidates_[i] = {};
  const Verdict fault = check(sighting);
  if (fault != Verdict::kMatched) return fault;
  if (sighting.identity < 0) {
    return local_.offer(i, sighting, body(sighting)) ? Verdict::kAdded : Verdict::kPassedOver;
  }
  candidate = find_identity(filter_, sighting, body(sighting));
  if (candidate.landmark == Candidate::kNone) return Verdict::kAdded;
  return candidate.mahalanobis_sq < kKnownGateSq ? Verdict::kMatched : Verdict::kOutlier;
}

/// Of the sightings matched to one landmark, the nearest keeps it.
void Slam::keep_best_pairs(std::span<Verdict> verdicts) {
  constexpr std::size_t kNobody = Candidate::kNone;
  std::fill_n(claimed_by_.begin(), filter_.landmark_count(), kNobody);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i] != Verdict::kMatched) continue;
    std::size_t& owner = claimed_by_[candidates_[i].landmark];
    const bool wins =
        owner == kNobody || candidates_[i].mahalanobis_sq < candidates_[owner].mahalanobis_sq;
    const std::size_t loser = wins ? owner : i;
    if (loser != kNobody) verdicts[loser] = Verdict::kTaken;
    if (wins) owner = i;
  }
}

/// Keeps account of the gate's answers about known identities. True if they say that it is the pose
/// which is wrong: it is then widened, and everything judged anew.
bool Slam::learn_from_refusals(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (sightings[i].identity < 0) continue;
    if (verdicts[i] != Verdict::kMatched && verdicts[i] != Verdict::kOutlier) continue;
    const bool accepted = verdicts[i] == Verdict::kMatched;
    Landmark& landmark = filter_.landmark(candidates_[i].landmark);
    landmark.refusals = accepted ? 0 : landmark.refusals + 1;
    gate_monitor_.record(landmark.map_id, accepted);
    if (!map_is_fixed_ && landmark.refusals >= kRefusalsMax &&
        gate_monitor_.others_are_accepted(landmark.map_id)) {
      verdicts[i] = Verdict::kReplaced;
    }
  }
  if (gate_monitor_.is_healthy()) widening_ratio_ = 1.0;
  if (!gate_monitor_.pose_is_doubtful()) return false;
  widen_pose();
  judge_all(sightings, verdicts);
  return true;
}

void Slam::widen_pose() {
  filter_.widen_pose(widening_ratio_ * kWideningPosition_m, widening_ratio_ * kWideningHeading_rad);
  widening_ratio_ = std::min(2.0 * widening_ratio_, kWideningRatioMax);
  gate_monitor_.clear();
}

void Slam::update(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  batch_.clear();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (verdicts[i] != Verdict::kMatched) continue;
    batch_.push_back(i);
    if (batch_.size() == SlamFilter::kResidualsMax) update_batch(sightings, verdicts);
  }
  update_batch(sightings, verdicts);
}

void Slam::update_batch(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  residuals_.clear();
  for (const std::size_t i : batch_) {
    const BodyObservation seen = body(sightings[i]);
    residuals_.push_back(softened_residual(candidates_[i].landmark, seen));
  }
  const bool used = filter_.update(residuals_) == UpdateResult::kUsed;
  if (used && !batch_.empty()) noise_monitor_.record(filter_.last_innovation());
  for (const std::size_t i : batch_) {
    if (!used) {
      verdicts[i] = Verdict::kSingular;
      continue;
    }
    Landmark& landmark = filter_.landmark(candidates_[i].landmark);
    if (!std::isfinite(landmark.first_sight_rad)) {
      landmark.first_sight_rad = sight_rad(body(sightings[i]));
    }
    landmark.times_seen = std::min(landmark.times_seen, kTimesSeenMax) + 1;
    landmark.signature = fused(landmark.signature, sightings[i].signature);
  }
  batch_.clear();
}

void Slam::replace_refused(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (verdicts[i] != Verdict::kReplaced) continue;
    const BodyObservation seen = body(sightings[i]);
    filter_.remove(find_identity(filter_, sightings[i], seen).landmark);
    if (!filter_.add(seen, begun(sightings[i]))) verdicts[i] = Verdict::kBudgetFull;
  }
}

void Slam::add_new(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  tentative_.begin(travel_m_);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (verdicts[i] != Verdict::kAdded) continue;
    const bool is_known = sightings[i].identity >= 0;
    verdicts[i] = map_is_fixed_ ? Verdict::kMapFixed
                  : is_known    ? add_known(sightings[i])
                                : add_unknown(i, sightings[i]);
    if (batch_.size() == SlamFilter::kResidualsMax) update_batch(sightings, verdicts);
  }
  update_batch(sightings, verdicts);
}

Verdict Slam::add_known(const Sighting& sighting) {
  const BodyObservation seen = body(sighting);
  const bool is_twice_in_frame =
      find_identity(filter_, sighting, seen).landmark != Candidate::kNone;
  if (is_twice_in_frame) return Verdict::kTaken;
  return filter_.add(seen, begun(sighting)) ? Verdict::kAdded : Verdict::kBudgetFull;
}

/// What becomes sure joins the map where it was first seen, and is measured by this sighting.
Verdict Slam::add_unknown(std::size_t i, const Sighting& sighting) {
  const BodyObservation seen = body(sighting);
  if (params_.confirm_sightings <= 1) {
    return filter_.add(seen, begun(sighting)) ? Verdict::kAdded : Verdict::kBudgetFull;
  }
  const std::size_t l = tentative_.find(sighting, seen);
  if (l == TentativeLandmarks::kNone) {
    return tentative_.begin_with(seen, begun(sighting)) ? Verdict::kTentative
                                                        : Verdict::kBudgetFull;
  }
  if (!tentative_.is_sure(l, params_.confirm_sightings)) return Verdict::kTentative;
  filter_.enter_in_map(l);
  filter_.landmark(l).times_seen = 0;
  filter_.landmark(l).first_seen_travel_m = travel_m_;
  candidates_[i].landmark = l;
  batch_.push_back(i);
  return Verdict::kAdded;
}

Landmark Slam::begun(const Sighting& sighting) const {
  return {.identity = sighting.identity,
          .kind = sighting.kind,
          .signature = cleaned(sighting.signature),
          .times_seen = 1,
          .first_seen_travel_m = travel_m_,
          .last_seen_travel_m = travel_m_,
          .range_off = {.off_m = 0.0, .travel_m = travel_m_},
          .first_sight_rad = sight_rad(body(sighting))};
}

void Slam::note_seen(std::span<const Sighting> sightings, std::span<const Verdict> verdicts) {
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i] != Verdict::kMatched && verdicts[i] != Verdict::kHeld) continue;
    const std::size_t l = candidates_[i].landmark;
    Landmark& landmark = filter_.landmark(l);
    landmark.last_seen_travel_m = travel_m_;
    if (!is_outline(landmark.kind)) continue;
    const BodyObservation seen = body(sightings[i]);
    landmark.range_off = range_off(filter_.observation_residual(l, seen), seen, travel_m_);
  }
}

/// Removing changes landmark numbers: those of this frame's candidates are not used after it.
void Slam::remove_what_is_gone(std::span<const Sighting> sightings,
                               std::span<const Verdict> verdicts, const VirtualScan& scan) {
  const auto gone = lifecycle_.weigh(filter_, sightings, verdicts, candidates_, scan);
  if (map_is_fixed_ || lifecycle_.says_lost()) return;
  for (const std::size_t l : gone) filter_.remove(l);
}

void Slam::merge_what_is_one() {
  merged_.clear();
  if (map_is_fixed_ || travel_m_ < closure_due_travel_m_) return;
  closure_due_travel_m_ = travel_m_ + kClosureEvery_m;
  merge(closure_.find(travel_m_));
  merge(twins_.find(travel_m_));
}

void Slam::merge(std::span<const LandmarkPair> pairs) {
  if (pairs.empty()) return;
  const std::size_t before = merged_.size();
  for (const LandmarkPair& pair : pairs) {
    merged_.push_back({filter_.landmark(pair.recent).map_id, filter_.landmark(pair.old).map_id});
  }
  const bool is_done = filter_.merge(pairs, ConstellationClosure::kSigma_m) == UpdateResult::kUsed;
  if (!is_done) merged_.resize(before);
}

}  // namespace roomwise::ekf
