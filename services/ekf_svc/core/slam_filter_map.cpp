// SlamFilter's map: what is in it; taken out and put back.
#include <algorithm>

#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

void SlamFilter::enter_in_map(std::size_t l) {
  landmarks_[l].is_tentative = false;
  landmarks_[l].map_id = next_map_id_++;
}

std::size_t SlamFilter::mapped_count() const {
  const auto is_mapped = [](const Landmark& landmark) { return !landmark.is_tentative; };
  return static_cast<std::size_t>(std::count_if(landmarks_.begin(), landmarks_.end(), is_mapped));
}

void SlamFilter::save(MapSnapshot& map) const {
  map.landmarks.clear();
  map.positions_m.clear();
  map.covariance_m2.clear();
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    if (landmarks_[l].is_tentative) continue;
    map.landmarks.push_back(landmarks_[l]);
    map.positions_m.push_back(landmark_position_m(l));
    for (const std::size_t i : {landmark_index(l), landmark_index(l) + 1}) {
      for (std::size_t j = i; j < size(); ++j) {
        if (landmarks_[(j - kRobotSize) / 2].is_tentative) continue;
        map.covariance_m2.push_back(covariance_.at(i, j));
      }
    }
  }
  map.calibration = calibration();
  map.calibration_covariance = robot_covariance().block<3, 3>(kCalibration, kCalibration);
  map.next_map_id = next_map_id_;
}

void SlamFilter::reset() {
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i) {
    x_.data()[i] = 0.0;
    std::fill(covariance_.row(i) + i, covariance_.row(i) + n, 0.0);
  }
  for (std::size_t i = 0; i < kPoseSize; ++i) covariance_.set(i, i, kStartVariance);
  landmarks_.clear();
  last_innovation_ = {};
}

bool SlamFilter::restore(const MapSnapshot& map, const Pose2& pose,
                         const Eigen::Matrix3d& pose_covariance) {
  if (map.landmarks.size() > budget_) return false;
  const std::vector<double> known(x_.data() + kCalibration, x_.data() + kRobotSize);
  const RobotMatrix known_covariance = robot_covariance();
  reset();
  double* x = x_.data();
  x[kHeading] = wrap_angle(pose.heading_rad);
  x[kPosition] = pose.x_m;
  x[kPosition + 1] = pose.y_m;
  std::copy(known.begin(), known.end(), x + kCalibration);
  for (std::size_t i = 0; i < kRobotSize; ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    for (std::size_t j = i; j < kRobotSize; ++j) {
      const auto c = static_cast<Eigen::Index>(j);
      if (j < kPoseSize) covariance_.set(i, j, pose_covariance(r, c));
      if (i >= kPoseSize) covariance_.set(i, j, known_covariance(r, c));
    }
  }
  landmarks_.assign(map.landmarks.begin(), map.landmarks.end());
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    x[landmark_index(l)] = map.positions_m[l].x();
    x[landmark_index(l) + 1] = map.positions_m[l].y();
  }
  const double* value = map.covariance_m2.data();
  for (std::size_t i = kRobotSize; i < size(); ++i) {
    for (std::size_t j = i; j < size(); ++j) covariance_.set(i, j, *value++);
  }
  for (std::size_t i = 0; i < kRobotSize; ++i) {
    std::fill(covariance_.row(i) + kRobotSize, covariance_.row(i) + size(), 0.0);
  }
  next_map_id_ = map.next_map_id;
  return true;
}

}  // namespace roomwise::ekf
