#include "services/ekf_svc/ekf_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/ekf_svc/core/outline.h"

namespace roomwise {
namespace {

// The core knows kinds by their numbers.
static_assert(ekf::is_outline(landmark_observation_t::KIND_EDGE_LEFT) &&
              ekf::is_outline(landmark_observation_t::KIND_EDGE_RIGHT) &&
              !ekf::is_outline(landmark_observation_t::KIND_CREASE_CONVEX) &&
              !ekf::is_outline(landmark_observation_t::KIND_POLE));

// A camera of 640 columns has six or more in each beam.
constexpr double kFirstBeam_rad = -0.8;
constexpr double kBeamStep_rad = 0.0125;
constexpr std::size_t kBeams = 128;

map_landmark_t to_map_landmark(const ekf::SlamFilter& filter, std::size_t l) {
  const ekf::Landmark& landmark = filter.landmark(l);
  const Eigen::Vector2d p_map_m = filter.landmark_position_m(l);
  const Eigen::Matrix2d covariance = filter.landmark_covariance_m2(l);
  map_landmark_t message{};
  message.map_id = landmark.map_id;
  message.identity = landmark.identity;
  message.kind = landmark.kind;
  message.map_x_m = p_map_m.x();
  message.map_y_m = p_map_m.y();
  message.covariance_x_x_m2 = covariance(0, 0);
  message.covariance_x_y_m2 = covariance(0, 1);
  message.covariance_y_y_m2 = covariance(1, 1);
  message.chroma_red_log = landmark.signature.red_log;
  message.chroma_blue_log = landmark.signature.blue_log;
  message.chroma_variance_log2 = landmark.signature.variance_log2;
  message.times_seen = landmark.times_seen;
  return message;
}

std::int8_t to_state(ekf::Estimator::State state) {
  switch (state) {
    case ekf::Estimator::State::kStarting:
      return pose_t::STATE_STARTING;
    case ekf::Estimator::State::kTracking:
      return pose_t::STATE_TRACKING;
    case ekf::Estimator::State::kLost:
      return pose_t::STATE_LOST;
    case ekf::Estimator::State::kRelocalised:
      return pose_t::STATE_RELOCALISED;
  }
  return pose_t::STATE_LOST;
}

void fill_quality(const ekf::Estimator& estimator, const ekf::FrameResult& last_frame,
                  pose_t& message) {
  const ekf::InnovationStatistics& innovation = estimator.filter().last_innovation();
  message.nis_dof = innovation.degrees_of_freedom;
  message.nis_ratio =
      innovation.degrees_of_freedom > 0 ? innovation.squared / innovation.degrees_of_freedom : 0.0;
  message.landmarks_in_map = static_cast<std::int32_t>(estimator.filter().mapped_count());
  message.landmarks_seen = last_frame.seen;
  message.landmarks_matched = last_frame.matched;
  message.landmarks_added = last_frame.added;
  message.landmarks_rejected = last_frame.rejected;
  message.landmarks_merged = last_frame.merged;
  message.landmark_noise_ratio = estimator.noise_ratio();
  message.state = to_state(estimator.state());
}

void fill_calibration(const ekf::SlamFilter& filter, pose_t& message) {
  const ekf::OdometryCalibration calibration = filter.calibration();
  message.distance_scale_ratio = 1.0 + calibration.distance_ratio();
  message.turn_scale_ratio = 1.0 + calibration.turn_ratio();
  message.turn_per_distance_rad_per_m = calibration.turn_per_distance_rad_per_m();
  const Eigen::Vector3d sigma = filter.robot_covariance().diagonal().segment<3>(3).cwiseSqrt();
  message.distance_scale_sigma_ratio = sigma(0);
  message.turn_scale_sigma_ratio = sigma(1);
  message.turn_per_distance_sigma_rad_per_m = sigma(2);
}

}  // namespace

ekf::OdometrySample to_sample(const odometry_t& message) {
  ekf::OdometrySample sample;
  sample.time = time_from_utime(message.utime);
  sample.interval = Duration(message.interval_us);
  sample.reset_counter = message.reset_counter;
  sample.distance_m = message.distance_increment_m;
  sample.turn_rad = message.turn_increment_rad;
  sample.covariance << message.covariance_distance_distance_m2,
      message.covariance_distance_turn_m_rad, message.covariance_distance_turn_m_rad,
      message.covariance_turn_turn_rad2;
  sample.is_asked_for = message.source == odometry_t::SOURCE_VELOCITY;
  sample.T_odom_robot = {message.x_m, message.y_m, message.heading_rad};
  return sample;
}

ekf::Sighting to_sighting(const landmark_observation_t& message) {
  ekf::Sighting sighting;
  sighting.polar.range_m = message.range_m;
  sighting.polar.bearing_rad = message.bearing_rad;
  sighting.polar.covariance << message.covariance_range_range_m2,
      message.covariance_range_bearing_m_rad, message.covariance_range_bearing_m_rad,
      message.covariance_bearing_bearing_rad2;
  sighting.identity = message.identity;
  sighting.kind = message.kind;
  sighting.moving = message.moving != 0;
  sighting.signature = {message.chroma_red_log, message.chroma_blue_log,
                        message.chroma_variance_log2};
  return sighting;
}

ScanBeams::ScanBeams(const landmark_list_t& message) {
  const auto count = std::min({message.scan_x_m.size(), message.scan_y_m.size(),
                               static_cast<std::size_t>(std::max(0, message.scan_count))});
  if (count == 0) return;
  range_m_.assign(kBeams, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < count; ++i) {
    const float x_m = message.scan_x_m[i], y_m = message.scan_y_m[i];
    const double beam = (std::atan2(y_m, x_m) - kFirstBeam_rad) / kBeamStep_rad;
    if (!(beam >= 0.0 && beam < static_cast<double>(kBeams))) continue;  // NaN, too
    float& nearest_m = range_m_[static_cast<std::size_t>(beam)];
    nearest_m = std::fmin(nearest_m, std::hypot(x_m, y_m));
  }
}

ekf::VirtualScan ScanBeams::scan() const { return {kFirstBeam_rad, kBeamStep_rad, range_m_}; }

pose_t to_pose_message(const ekf::Estimator& estimator, const ekf::FrameResult& last_frame) {
  const ekf::PoseEstimate estimate = estimator.estimate();
  pose_t message{};
  message.utime = utime_of(estimate.time);
  message.x_m = estimate.T_map_robot.x_m;
  message.y_m = estimate.T_map_robot.y_m;
  message.heading_rad = estimate.T_map_robot.heading_rad;
  const Eigen::Matrix3d& P = estimate.covariance;
  message.covariance_x_x_m2 = P(1, 1);
  message.covariance_x_y_m2 = P(1, 2);
  message.covariance_y_y_m2 = P(2, 2);
  message.covariance_x_heading_m_rad = P(0, 1);
  message.covariance_y_heading_m_rad = P(0, 2);
  message.covariance_heading_heading_rad2 = P(0, 0);
  fill_quality(estimator, last_frame, message);
  fill_calibration(estimator.filter(), message);
  return message;
}

landmark_map_t to_map_message(const ekf::Estimator& estimator) {
  const ekf::SlamFilter& filter = estimator.filter();
  landmark_map_t message{};
  message.utime = utime_of(estimator.estimate().time);
  for (std::size_t l = 0; l < filter.landmark_count(); ++l) {
    if (filter.landmark(l).is_tentative) continue;
    message.map_landmarks.push_back(to_map_landmark(filter, l));
  }
  std::sort(message.map_landmarks.begin(), message.map_landmarks.end(),
            [](const auto& a, const auto& b) { return a.map_id < b.map_id; });
  message.map_count = static_cast<std::int32_t>(message.map_landmarks.size());
  return message;
}

}  // namespace roomwise
