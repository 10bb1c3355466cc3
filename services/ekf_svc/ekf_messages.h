#pragma once
#include <vector>

#include "common/channels.h"
#include "services/ekf_svc/core/estimator.h"

namespace roomwise {

/// ODOMETRY as the core takes it.
ekf::OdometrySample to_sample(const odometry_t& message);

/// One element of LANDMARKS as the core takes it.
ekf::Sighting to_sighting(const landmark_observation_t& message);

/// The nearest thing by bearing, of the points LANDMARKS tells of the view; NaN where it tells
/// none. As from the robot's centre: a camera that sits a few cm off it sees a little more or less.
class ScanBeams {
 public:
  /// Empty if the frame has no point in view.
  explicit ScanBeams(const landmark_list_t& message);

  ekf::VirtualScan scan() const;

 private:
  std::vector<float> range_m_;
};

/// POSE for the newest odometry, after `last_frame`.
pose_t to_pose_message(const ekf::Estimator& estimator, const ekf::FrameResult& last_frame);

/// LANDMARK_MAP as of the newest odometry, in order of map_id.
landmark_map_t to_map_message(const ekf::Estimator& estimator);

}  // namespace roomwise
