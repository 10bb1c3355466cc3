#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace roomwise::ekf {

/// Two non-zero columns of a Jacobian, and where in the state they stand.
struct JacobianBlock {
  std::size_t index = 0;  ///< first state component of the point
  Eigen::Matrix2d value = Eigen::Matrix2d::Zero();
};

/// What a measurement of dimension 2 says, linearised at the state:
///   innovation = measured - predicted = H error + noise,
/// with H non-zero for the heading, the range calibration and two points of the state only.
struct Residual {
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< its covariance
  /// Added to the noise for the correction alone: so much less it is to pull. What is said of the
  /// normalised innovation does not count it.
  Eigen::Matrix2d softening = Eigen::Matrix2d::Zero();
  Eigen::Vector2d heading = Eigen::Vector2d::Zero();      ///< column of H for the heading
  Eigen::Matrix2d calibration = Eigen::Matrix2d::Zero();  ///< columns of H for RangeCalibration
  std::array<JacobianBlock, 2> points;
};

}  // namespace roomwise::ekf
