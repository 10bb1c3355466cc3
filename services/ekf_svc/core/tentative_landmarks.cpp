#include "services/ekf_svc/core/tentative_landmarks.h"

#include <algorithm>
#include <cmath>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/outline.h"
#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {
namespace {

constexpr double kForgetAfter_m = 2.0;  // of way without another sighting
constexpr double kGateSq =
    5.99;  // 95 % of two degrees of freedom: a wrong pair corrects the filter
constexpr std::size_t kRoom = 64;  // for what a frame may begin
constexpr double kBaseline_m = 0.1;
constexpr double kBaseline_rad = 0.087;

bool is_from_elsewhere(const Pose2& a, const Pose2& b) {
  return (a.position_m() - b.position_m()).norm() >= kBaseline_m ||
         std::abs(wrap_angle(a.heading_rad - b.heading_rad)) >= kBaseline_rad;
}

}  // namespace

TentativeLandmarks::TentativeLandmarks(SlamFilter& filter) : filter_(&filter) {
  things_.reserve(kThingsMax);
}

void TentativeLandmarks::begin(double travel_m) {
  travel_m_ = travel_m;
  for (std::size_t l = filter_->landmark_count(); l-- > 0;) {
    const Landmark& landmark = filter_->landmark(l);
    if (!landmark.is_tentative) continue;
    if (travel_m - landmark.last_seen_travel_m > kForgetAfter_m) filter_->remove(l);
  }
  collect();
  if (things_.size() > kThingsMax - kRoom) forget_oldest(kThingsMax - kRoom);
}

std::size_t TentativeLandmarks::find(const Sighting& sighting, const BodyObservation& seen) {
  Thing* best = nullptr;
  double best_sq = kGateSq;
  RangeOff best_off;
  for (Thing& thing : things_) {
    const Landmark& landmark = filter_->landmark(thing.landmark);
    if (thing.is_seen || landmark.kind != sighting.kind) continue;
    const Residual residual = filter_->observation_residual(thing.landmark, seen);
    const RangeOff off = range_off(residual, seen, travel_m_);
    if (!may_be(landmark, off)) continue;
    const SignatureDistance colour = distance(sighting.signature, landmark.signature);
    const double squared =
        mahalanobis_sq(residual.innovation, filter_->innovation_covariance(residual)) +
        colour.squared;
    if (!(squared < best_sq)) continue;
    best_sq = squared;
    best_off = off;
    best = &thing;
  }
  if (best == nullptr) return kNone;
  best->is_seen = true;
  Landmark& landmark = filter_->landmark(best->landmark);
  landmark.last_seen_travel_m = travel_m_;
  landmark.range_off = best_off;
  ++landmark.times_seen;
  return best->landmark;
}

bool TentativeLandmarks::is_sure(std::size_t landmark, int times) const {
  const Landmark& thing = filter_->landmark(landmark);
  return thing.times_seen >= times && is_from_elsewhere(thing.first_seen_from, filter_->pose());
}

bool TentativeLandmarks::begin_with(const BodyObservation& seen, const Landmark& landmark) {
  if (count_ >= kThingsMax) return false;
  Landmark tentative = landmark;
  tentative.is_tentative = true;
  tentative.first_seen_from = filter_->pose();
  if (!filter_->add(seen, tentative)) return false;
  ++count_;
  return true;
}

void TentativeLandmarks::collect() {
  things_.clear();
  for (std::size_t l = 0; l < filter_->landmark_count(); ++l) {
    if (filter_->landmark(l).is_tentative) things_.push_back({l, false});
  }
  count_ = things_.size();
}

/// All but `left` of them: those go that were not seen for longest.
void TentativeLandmarks::forget_oldest(std::size_t left) {
  collect();
  while (things_.size() > left) {
    const auto oldest =
        std::min_element(things_.begin(), things_.end(), [this](const Thing& a, const Thing& b) {
          return filter_->landmark(a.landmark).last_seen_travel_m <
                 filter_->landmark(b.landmark).last_seen_travel_m;
        });
    filter_->remove(oldest->landmark);
    collect();
  }
}

}  // namespace roomwise::ekf
