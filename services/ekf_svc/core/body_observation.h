#pragma once
#include <Eigen/Core>
#include <cmath>

#include "services/ekf_svc/core/range_calibration.h"

namespace roomwise::ekf {

/// A landmark as seen from the robot: x forward, y left.
struct BodyObservation {
  Eigen::Vector2d p_robot_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();  ///< of p_robot_m
  /// d (place measured at the true calibration) / d RangeCalibration. Shape 2 x 2 [m].
  Eigen::Matrix2d per_calibration = Eigen::Matrix2d::Zero();
};

/// Range and bearing as a detector gives them.
///   covariance  2 x 2  of (range, bearing) [m^2, m rad, rad^2]
struct PolarObservation {
  double range_m = 0.0;      ///< > 0
  double bearing_rad = 0.0;  ///< counter-clockwise from robot x
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// From polar to Cartesian: z = r (cos b, sin b), covariance C R C^T with
/// C = [cos b, -r sin b; sin b, r cos b] at the measured values. The biases, which repeat from
/// frame to frame, widen it along and across the line of sight. The range is corrected by
/// `calibration`.
inline BodyObservation to_body(const PolarObservation& seen, double range_bias_m,
                               double lateral_bias_m, const RangeCalibration& calibration = {}) {
  const double c = std::cos(seen.bearing_rad);
  const double s = std::sin(seen.bearing_rad);
  const Eigen::Matrix2d line_of_sight = (Eigen::Matrix2d() << c, -s, s, c).finished();
  Eigen::Matrix2d along_across = seen.covariance;
  along_across.row(1) *= seen.range_m;
  along_across.col(1) *= seen.range_m;
  along_across(0, 0) += range_bias_m * range_bias_m;
  along_across(1, 1) += lateral_bias_m * lateral_bias_m;
  const double ratio = calibration.ratio(seen.bearing_rad);
  const Eigen::Vector2d p_robot_m = seen.range_m / ratio * line_of_sight.col(0);
  return {p_robot_m, line_of_sight * along_across * line_of_sight.transpose(),
          p_robot_m / ratio * RangeCalibration::shape(seen.bearing_rad).transpose()};
}

}  // namespace roomwise::ekf
