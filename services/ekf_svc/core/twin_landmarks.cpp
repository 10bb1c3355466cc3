#include "services/ekf_svc/core/twin_landmarks.h"

#include <algorithm>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/chi_square.h"
#include "services/ekf_svc/core/constellation_closure.h"

namespace roomwise::ekf {
namespace {

constexpr double kTwinRecentTravel_m = 4.0;
constexpr std::int32_t kTwinTimesSeenMin = 5;
constexpr double kWellKnownSigma_m = 0.05;
constexpr double kTwinRivalSqMin = 25.0;
constexpr double kTwinReach_m = 1.0;
constexpr std::size_t kNoTwin = Candidate::kNone;
constexpr double kTwinSigma_m = ConstellationClosure::kSigma_m;

}  // namespace

TwinLandmarks::TwinLandmarks(const SlamFilter& filter) : filter_(&filter) {
  pairs_.reserve(SlamFilter::kResidualsMax);
}

std::span<const LandmarkPair> TwinLandmarks::find(double travel_m) {
  pairs_.clear();
  for (std::size_t a = 0; a < filter_->landmark_count(); ++a) {
    const Landmark& landmark = filter_->landmark(a);
    if (landmark.identity >= 0 || landmark.is_tentative) continue;
    if (landmark.times_seen < kTwinTimesSeenMin) continue;
    if (travel_m - landmark.last_seen_travel_m > kTwinRecentTravel_m) continue;
    const std::size_t b = only_twin_of(a);
    if (b == kNoTwin || pairs_.size() == SlamFilter::kResidualsMax) continue;
    const bool is_free = std::none_of(pairs_.begin(), pairs_.end(), [=](const LandmarkPair& pair) {
      return pair.old == b || pair.recent == b || pair.old == a;
    });
    if (is_free) pairs_.push_back({a, b});
  }
  return pairs_;
}

/// The one landmark that can be the same as `recent`, or kNoTwin.
std::size_t TwinLandmarks::only_twin_of(std::size_t recent) const {
  std::size_t twin = kNoTwin;
  for (std::size_t b = 0; b < filter_->landmark_count(); ++b) {
    if (b == recent || filter_->landmark(b).is_tentative) continue;
    if (!may_be_one(filter_->landmark(recent), filter_->landmark(b))) continue;
    const Eigen::Vector2d apart =
        filter_->landmark_position_m(recent) - filter_->landmark_position_m(b);
    if (apart.squaredNorm() > kTwinReach_m * kTwinReach_m) continue;
    const Fit fit_b = fit(recent, b);
    if (fit_b.squared > kTwinRivalSqMin) continue;
    const bool fits = fit_b.is_well_known && fit_b.squared < chi_square_quantile(2, kNormal95) &&
                      filter_->landmark(b).times_seen >= kTwinTimesSeenMin;
    if (!fits || twin != kNoTwin) return kNoTwin;
    twin = b;
  }
  return twin;
}

TwinLandmarks::Fit TwinLandmarks::fit(std::size_t recent, std::size_t old) const {
  const Residual residual = filter_->equality_residual(recent, old, kTwinSigma_m);
  const Eigen::Matrix2d S = filter_->innovation_covariance(residual);
  const double relative_m2 = S.trace() - residual.noise.trace();
  return {mahalanobis_sq(residual.innovation, S),
          relative_m2 < 2.0 * kWellKnownSigma_m * kWellKnownSigma_m};
}

}  // namespace roomwise::ekf
