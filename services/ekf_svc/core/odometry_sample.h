#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "common/geometry/pose2.h"
#include "common/time.h"

namespace roomwise::ekf {

/// One report of the wheels.
struct OdometrySample {
  Time time{};          ///< end of the interval
  Duration interval{};  ///< its length
  std::int32_t reset_counter = 0;
  double distance_m = 0.0;
  double turn_rad = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (distance, turn)
  Pose2 T_odom_robot;                                    ///< sum of the increments
  bool is_asked_for = false;  ///< speeds the robot was told, not what its wheels counted
};

/// What became of a report.
enum class OdometryVerdict : std::uint8_t {
  kUsed,
  kFirst,              ///< the map begins where the robot stands now
  kGap,                ///< used; reports before it were missing
  kRestarted,          ///< used; its clock went back or jumped ahead, and stayed there
  kTimeInvalid,        ///< no time at all, or an interval that is not one
  kOutOfOrder,         ///< not later than the last, or ahead beyond belief
  kNotFinite,          ///< NaN or infinite
  kTooFast,            ///< no robot of the kind moves like that
  kCovarianceInvalid,  ///< not positive semidefinite, or absurdly large
};

constexpr bool is_used(OdometryVerdict verdict) { return verdict <= OdometryVerdict::kRestarted; }

/// kUsed if the sample's own numbers can be used, else what is wrong with them.
OdometryVerdict check(const OdometrySample& sample);

}  // namespace roomwise::ekf
