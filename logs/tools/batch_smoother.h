#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/ekf_svc/core/motion.h"
#include "services/ekf_svc/core/range_calibration.h"

namespace roomwise {

/// One landmark seen from one node.
struct SmoothSighting {
  std::size_t node = 0;
  std::size_t landmark = 0;
  Eigen::Vector2d p_robot_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
};

/// Everything a drive says about its path and its map at once, and where to start from.
struct SmoothProblem {
  std::vector<std::int64_t> utimes;           ///< of the nodes
  std::vector<Pose2> poses;                   ///< first guess; the answer
  std::vector<ekf::MotionIncrement> motions;  ///< from node i to i + 1, with `calibration`
  ekf::OdometryCalibration calibration;       ///< first guess; the answer
  ekf::RangeCalibration ranges;               ///< first guess; the answer
  std::vector<Eigen::Vector2d> landmarks_m;   ///< first guess; the answer
  std::vector<SmoothSighting> sightings;
};

struct SmoothReport {
  double cost_before = 0.0;
  double cost_after = 0.0;
  int iterations = 0;
  bool converged = false;
};

/// The most likely path, map and calibration of odometry and ranges together (maximum a posteriori,
/// all poses linearised anew in each iteration): what a filter, which never looks back, can at best
/// come near to. Sightings count with Cauchy's loss, so that a misread landmark bends nothing. The
/// first pose is held.
SmoothReport smooth(SmoothProblem& problem);

}  // namespace roomwise
