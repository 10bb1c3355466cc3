#include "services/landmark_svc/core/landmark.h"

#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise::landmark {

void set_position(Landmark& landmark, const Eigen::Vector2d& p_robot_m,
                  const Eigen::Matrix2d& covariance_m2) {
  const double range_m = p_robot_m.norm();
  const Eigen::Vector2d toward = p_robot_m / range_m;
  Eigen::Matrix2d jacobian;
  jacobian << toward.x(), toward.y(), -toward.y() / range_m, toward.x() / range_m;
  const Eigen::Matrix2d polar = jacobian * covariance_m2 * jacobian.transpose();
  landmark.range_m = range_m;
  landmark.bearing_rad = wrap_angle(std::atan2(p_robot_m.y(), p_robot_m.x()));
  landmark.covariance = 0.5 * (polar + polar.transpose());
}

}  // namespace roomwise::landmark
