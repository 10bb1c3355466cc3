#include "services/ekf_svc/core/tentative_landmarks.h"

#include <algorithm>
#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr double kForgetAfter_m = 2.0;  // of way without another sighting
constexpr double kGateSq = 9.21;
constexpr double kDriftVariance_m2 = 0.03 * 0.03;  // of the pose between two sightings
constexpr double kBaseline_m = 0.1;
constexpr double kBaseline_rad = 0.087;

bool is_from_elsewhere(const Pose2& a, const Pose2& b) {
  return (a.position_m() - b.position_m()).norm() >= kBaseline_m ||
         std::abs(wrap_angle(a.heading_rad - b.heading_rad)) >= kBaseline_rad;
}

}  // namespace

void TentativeLandmarks::begin(const Pose2& T_map_robot, double travel_m) {
  T_map_robot_ = T_map_robot;
  travel_m_ = travel_m;
  ++frame_;
  std::erase_if(things_, [this](const Thing& thing) {
    return travel_m_ - thing.last_seen_travel_m > kForgetAfter_m;
  });
}

bool TentativeLandmarks::confirms(const Sighting& sighting, const BodyObservation& seen,
                                  int times) {
  if (times <= 1) return true;
  const Eigen::Vector2d p_map_m = transform(T_map_robot_, seen.p_robot_m);
  const double variance_m2 = 0.5 * seen.covariance_m2.trace();
  Thing* thing = nearest(sighting, p_map_m, variance_m2);
  if (thing == nullptr) {
    remember({p_map_m, variance_m2, sighting.kind, T_map_robot_, travel_m_, 1, frame_});
    return false;
  }
  thing->p_map_m = p_map_m;
  thing->variance_m2 = variance_m2;
  thing->last_seen_travel_m = travel_m_;
  thing->frame = frame_;
  ++thing->times_seen;
  if (thing->times_seen < times || !is_from_elsewhere(thing->first_seen_from, T_map_robot_)) {
    return false;
  }
  things_.erase(things_.begin() + (thing - things_.data()));
  return true;
}

TentativeLandmarks::Thing* TentativeLandmarks::nearest(const Sighting& sighting,
                                                       const Eigen::Vector2d& p_map_m,
                                                       double variance_m2) {
  Thing* best = nullptr;
  double best_sq = kGateSq;
  for (Thing& thing : things_) {
    if (thing.kind != sighting.kind || thing.frame == frame_) continue;
    const double squared = (thing.p_map_m - p_map_m).squaredNorm() /
                           (thing.variance_m2 + variance_m2 + kDriftVariance_m2);
    if (squared >= best_sq) continue;
    best_sq = squared;
    best = &thing;
  }
  return best;
}

/// When full, what was not seen for longest makes room.
void TentativeLandmarks::remember(const Thing& thing) {
  if (things_.size() < kThingsMax) return things_.push_back(thing);
  *std::min_element(things_.begin(), things_.end(),
                    [](const Thing& a, const Thing& b) { return a.frame < b.frame; }) = thing;
}

}  // namespace roomwise::ekf
