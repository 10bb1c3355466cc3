#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/ekf_svc/core/landmark.h"
#include "services/ekf_svc/core/odometry_calibration.h"

namespace roomwise::ekf {

/// Everything a filter needs to go on with a map later, from another place.
struct MapSnapshot {
  std::vector<Landmark> landmarks;
  std::vector<Eigen::Vector2d> positions_m;  ///< map frame, one per landmark
  /// Upper triangle of the landmarks' 2 L x 2 L covariance, row by row [m^2].
  std::vector<double> covariance_m2;
  OdometryCalibration calibration;
  Eigen::Matrix3d calibration_covariance = Eigen::Matrix3d::Zero();
  std::int64_t next_map_id = 1;

  bool empty() const { return landmarks.empty(); }
  double covariance(std::size_t i, std::size_t j) const {
    if (i > j) return covariance(j, i);
    return covariance_m2[i * 2 * landmarks.size() - i * (i + 1) / 2 + j];
  }
};

}  // namespace roomwise::ekf
