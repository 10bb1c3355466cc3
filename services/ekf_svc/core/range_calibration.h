#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace roomwise::ekf {

/// What a sensor's ranges get wrong all the time, over its field of view: a distance along the
/// optical axis given for one along the ray, an axis that is not where it is said to be, a lens.
///   measured range = (1 + tilt P1(u) + curvature P2(u)) true range,  u = bearing / half view,
/// with Legendre's P1 = u, P2 = (3 u^2 - 1) / 2. Their mean over the view is 0: what is wrong with
/// the ranges as a whole cannot be told from a map of another size, so that the sensor is taken at
/// its word there. For the depth z given as range, z = r cos(bearing): curvature -0.08.
struct RangeCalibration {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();  ///< (tilt, curvature) [-]

  /// (P1, P2) at a bearing; outside the view as at its edge. Either is at most 1.
  static Eigen::Vector2d shape(double bearing_rad) {
    const double u = std::clamp(bearing_rad / kHalfView_rad, -1.0, 1.0);
    return {u, 1.5 * u * u - 0.5};
  }

  /// Measured per true range at a bearing. Kept away from 0, whatever was learned.
  double ratio(double bearing_rad) const {
    return std::max(0.5, 1.0 + value.dot(shape(bearing_rad)));
  }

  static constexpr double kHalfView_rad = 0.5;  ///< a camera of 57 degrees
};

}  // namespace roomwise::ekf
