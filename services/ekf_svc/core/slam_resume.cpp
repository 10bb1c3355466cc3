// Slam between maps: begun anew, or gone on with after relocalisation.
#include <stdexcept>

#include "services/ekf_svc/core/slam.h"

namespace roomwise::ekf {
namespace {

constexpr double kLongAgo_m = -1e9;  // way gone when a saved map's landmarks were last seen

// What the fit says of the pose is said again by the landmarks below: start from next to nothing.
constexpr double kStartSigma_m = 0.5;
constexpr double kStartSigma_rad = 0.2;

// The local map's landmarks share the drift of the way between them, which is taken for noise of
// each: the better half of it counts twice.
constexpr double kSharedDrift = 2.0;

/// Of the landmark with this map_id, which the filter has.
std::size_t number_of(const SlamFilter& filter, std::int64_t map_id) {
  for (std::size_t l = 0; l < filter.landmark_count(); ++l) {
    if (filter.landmark(l).map_id == map_id) return l;
  }
  throw std::logic_error("Slam: the local map is not the filter's");
}

/// Landmark `l` of the filter as if seen from where the robot is now.
BodyObservation as_seen_now(const SlamFilter& filter, std::size_t l) {
  const Residual residual = filter.observation_residual(l, {});
  BodyObservation seen;
  seen.p_robot_m = -residual.innovation;
  seen.covariance_m2 = kSharedDrift * filter.innovation_covariance(residual);
  return seen;
}

}  // namespace

void Slam::begin_anew() {
  filter_.fix_map(false);
  map_is_fixed_ = false;
  filter_.reset();
  gate_monitor_.clear();
  lifecycle_.clear();
  free_calibrations();
}

bool Slam::resume(const MapSnapshot& map, const MapSnapshot& local,
                  const Relocaliser::Place& place) {
  std::vector<BodyObservation> seen;
  for (const LandmarkPair& pair : place.pairs) {
    seen.push_back(as_seen_now(filter_, number_of(filter_, local.landmarks[pair.recent].map_id)));
  }
  const Pose2 pose = compose(place.fit.T_map_local, filter_.pose());
  const Eigen::Vector3d variance(kStartSigma_rad * kStartSigma_rad, kStartSigma_m * kStartSigma_m,
                                 kStartSigma_m * kStartSigma_m);
  if (!filter_.restore(map, pose, variance.asDiagonal())) return false;
  for (std::size_t l = 0; l < filter_.landmark_count(); ++l) {
    Landmark& landmark = filter_.landmark(l);
    landmark.first_seen_travel_m = landmark.last_seen_travel_m = kLongAgo_m;
    landmark.refusals = 0;
  }
  map_is_fixed_ = params_.mode == "localise";
  filter_.fix_map(map_is_fixed_);
  residuals_.clear();
  for (std::size_t i = 0; i < place.pairs.size(); ++i) {
    const std::size_t l = place.pairs[i].old;
    residuals_.push_back(filter_.observation_residual(l, seen[i]));
    filter_.landmark(l).last_seen_travel_m = travel_m_;
  }
  gate_monitor_.clear();
  lifecycle_.clear();
  return filter_.update(residuals_) == UpdateResult::kUsed;
}

}  // namespace roomwise::ekf
