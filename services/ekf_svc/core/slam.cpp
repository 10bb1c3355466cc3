#include "services/ekf_svc/core/slam.h"

#include <algorithm>

#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {
namespace {

constexpr double kNewLandmarkSq = 25.0;

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
              static_cast<std::size_t>(params.landmark_budget)) {
  candidates_.reserve(kSightingsExpected);
  claimed_by_.resize(filter_.landmark_budget());
  batch_.reserve(SlamFilter::kResidualsMax);
  residuals_.reserve(SlamFilter::kResidualsMax);
}

FrameResult Slam::process(std::span<const Sighting> sightings, bool may_update,
                          std::span<Verdict> verdicts) {
  FrameResult result{.seen = static_cast<int>(sightings.size())};
  candidates_.resize(sightings.size());
  judge_all(sightings, verdicts);
  if (may_update) {
    result.pose_widened = learn_from_refusals(sightings, verdicts);
    update(sightings, verdicts);
  } else {
    std::replace(verdicts.begin(), verdicts.end(), Verdict::kMatched, Verdict::kHeld);
  }
  add_new(sightings, verdicts);
  tally(verdicts, result);
  return result;
}

BodyObservation Slam::body(const Sighting& sighting) const {
  return to_body(sighting.polar, params_.range_bias_m, params_.lateral_bias_m);
}

void Slam::judge_all(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    verdicts[i] = judge(sightings[i], candidates_[i]);
  }
  keep_best_pairs(verdicts);
}

Verdict Slam::judge(const Sighting& sighting, Candidate& candidate) const {
  candidate = {};
  const Verdict fault = check(sighting);
  if (fault != Verdict::kMatched) return fault;
  const bool is_known = sighting.identity >= 0;
  candidate = is_known ? find_identity(filter_, sighting, body(sighting))
                       : find_nearest(filter_, sighting, body(sighting), kNewLandmarkSq);
  if (candidate.landmark == Candidate::kNone) return Verdict::kAdded;
  if (is_known) {
    return candidate.mahalanobis_sq < kKnownGateSq ? Verdict::kMatched : Verdict::kOutlier;
  }
  if (candidate.mahalanobis_sq < candidate.gate_sq) return Verdict::kMatched;
  return candidate.mahalanobis_sq > kNewLandmarkSq ? Verdict::kAdded : Verdict::kAmbiguous;
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
    if (landmark.refusals >= kRefusalsMax && gate_monitor_.others_are_accepted(landmark.map_id)) {
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
    residuals_.push_back(filter_.observation_residual(candidates_[i].landmark, body(sightings[i])));
  }
  const bool used = filter_.update(residuals_) == UpdateResult::kUsed;
  for (const std::size_t i : batch_) {
    if (!used) {
      verdicts[i] = Verdict::kSingular;
      continue;
    }
    Landmark& landmark = filter_.landmark(candidates_[i].landmark);
    landmark.times_seen = std::min(landmark.times_seen, kTimesSeenMax) + 1;
    landmark.signature = fused(landmark.signature, sightings[i].signature);
  }
  batch_.clear();
}

void Slam::add_new(std::span<const Sighting> sightings, std::span<Verdict> verdicts) {
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (verdicts[i] == Verdict::kReplaced) {
      filter_.remove(find_identity(filter_, sightings[i], body(sightings[i])).landmark);
      if (add(sightings[i]) != Verdict::kAdded) verdicts[i] = Verdict::kBudgetFull;
    } else if (verdicts[i] == Verdict::kAdded) {
      verdicts[i] = add(sightings[i]);
    }
  }
}

Verdict Slam::add(const Sighting& sighting) {
  const BodyObservation seen = body(sighting);
  const bool twice_in_frame =
      sighting.identity >= 0 && find_identity(filter_, sighting, seen).landmark != Candidate::kNone;
  if (twice_in_frame) return Verdict::kTaken;
  const Landmark landmark{.identity = sighting.identity,
                          .kind = sighting.kind,
                          .signature = sighting.signature,
                          .times_seen = 1};
  return filter_.add(seen, landmark) ? Verdict::kAdded : Verdict::kBudgetFull;
}

}  // namespace roomwise::ekf
