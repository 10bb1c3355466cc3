#include "services/ekf_svc/core/landmark_lifecycle.h"

#include <algorithm>
#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr int kScoreMax = 20;
constexpr int kScoreGone = -4;
constexpr double kBehind_rad = 0.035;  // as seen past a thin thing's edge
constexpr double kBehind_m = 0.3;
constexpr double kBeside_rad = 0.02;  // every beam so near must have gone past
constexpr double kSigmaMax_m = 0.1;   // of the landmark's place relative to the robot

bool counts_as_seen(Verdict verdict) {
  return verdict == Verdict::kMatched || verdict == Verdict::kHeld;
}

/// Whether all beams within `beside_rad` of a bearing were measured and end beyond `range_m`.
bool sees_beyond(const VirtualScan& scan, double bearing_rad, double beside_rad, double range_m) {
  const auto beam_at = [&scan](double at_rad) {
    return std::floor((at_rad - scan.first_bearing_rad) / scan.bearing_step_rad);
  };
  const double first = beam_at(bearing_rad - beside_rad), last = beam_at(bearing_rad + beside_rad);
  if (first < 0.0 || last >= static_cast<double>(scan.range_m.size())) return false;
  const auto beams = scan.range_m.subspan(static_cast<std::size_t>(first),
                                          static_cast<std::size_t>(last - first) + 1);
  return std::all_of(beams.begin(), beams.end(),
                     [range_m](float beam_m) { return static_cast<double>(beam_m) > range_m; });
}

}  // namespace

LandmarkLifecycle::LandmarkLifecycle(const SlamFilter& filter, const EkfParams& params)
    : half_view_rad_(params.view_half_angle_rad),
      range_min_m_(params.view_range_min_m),
      range_max_m_(params.view_range_max_m),
      is_seen_(filter.landmark_budget()) {
  leaving_.reserve(filter.landmark_budget());
}

std::span<const std::size_t> LandmarkLifecycle::weigh(SlamFilter& filter,
                                                      std::span<const Sighting> sightings,
                                                      std::span<const Verdict> verdicts,
                                                      std::span<const Candidate> candidates,
                                                      const VirtualScan& scan) {
  leaving_.clear();
  std::fill(is_seen_.begin(), is_seen_.end(), false);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (counts_as_seen(verdicts[i])) is_seen_[candidates[i].landmark] = true;
  }
  const Pose2 T_robot_map = inverse(filter.pose());
  for (std::size_t l = filter.landmark_count(); l-- > 0;) {
    Landmark& landmark = filter.landmark(l);
    if (landmark.identity >= 0 || landmark.is_tentative) continue;
    if (is_seen_[l]) {
      landmark.score = std::min(landmark.score + 1, kScoreMax);
      lost_monitor_.record(landmark.map_id, true);
      continue;
    }
    const Eigen::Vector2d p = transform(T_robot_map, filter.landmark_position_m(l));
    const double range_m = p.norm();
    const bool is_in_view = range_m > range_min_m_ && range_m < range_max_m_ &&
                            std::abs(std::atan2(p.y(), p.x())) < half_view_rad_;
    if (!is_in_view) continue;
    const Residual residual = filter.observation_residual(l, {});
    const double sigma_m = std::sqrt(0.5 * filter.innovation_covariance(residual).trace());
    if (sigma_m > kSigmaMax_m || !is_looked_through(p, sigma_m, sightings, scan)) continue;
    lost_monitor_.record(landmark.map_id, false);
    if (--landmark.score < kScoreGone) leaving_.push_back(l);
  }
  return leaving_;
}

bool LandmarkLifecycle::is_looked_through(const Eigen::Vector2d& p_robot_m, double sigma_m,
                                          std::span<const Sighting> sightings,
                                          const VirtualScan& scan) const {
  const double range_m = p_robot_m.norm();
  const double bearing_rad = std::atan2(p_robot_m.y(), p_robot_m.x());
  const double place_rad = 3.0 * sigma_m / range_m;
  const double behind_m = range_m + 3.0 * sigma_m + kBehind_m;
  if (!scan.range_m.empty()) {
    return sees_beyond(scan, bearing_rad, kBeside_rad + place_rad, behind_m);
  }
  const double window_rad = std::max(0.0, kBehind_rad - place_rad);
  return std::any_of(sightings.begin(), sightings.end(), [&](const Sighting& seen) {
    return check(seen) == Verdict::kMatched && seen.polar.range_m > behind_m &&
           std::abs(wrap_angle(seen.polar.bearing_rad - bearing_rad)) < window_rad;
  });
}

}  // namespace roomwise::ekf
