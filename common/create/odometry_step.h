#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "common/geometry/pose2.h"
#include "common/time.h"

namespace roomwise::create {

/// Where an odometry step comes from.
enum class OdometrySource : std::uint8_t {
  kWheels,  ///< encoder counts
  kBody,    ///< the robot's own distance and angle
};

/// Motion between two readings, and the pose it adds up to.
struct OdometryStep {
  Time time{};          ///< end of the interval
  Duration interval{};  ///< its length, > 0
  std::int32_t reset_counter = 0;
  OdometrySource source = OdometrySource::kWheels;
  int encoder_left_ticks = 0;  ///< raw counters; 0 from kBody
  int encoder_right_ticks = 0;
  double wheel_left_m = 0.0;
  double wheel_right_m = 0.0;
  double distance_m = 0.0;                               ///< along the arc, negative in reverse
  double turn_rad = 0.0;                                 ///< counter-clockwise positive
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (distance, turn)
  Pose2 T_odom_robot;
};

/// The pose after driving a circular arc of length `distance_m` that turns by `turn_rad`.
/// Chord of an arc: distance * sin(turn / 2) / (turn / 2), at the mean heading.
inline Pose2 drive_arc(const Pose2& T_odom_robot, double distance_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  const double ratio =
      std::abs(half_rad) < 1e-4 ? 1.0 - half_rad * half_rad / 6.0 : std::sin(half_rad) / half_rad;
  const double chord_m = distance_m * ratio;
  const double bearing_rad = T_odom_robot.heading_rad + half_rad;
  return {T_odom_robot.x_m + chord_m * std::cos(bearing_rad),
          T_odom_robot.y_m + chord_m * std::sin(bearing_rad),
          wrap_angle(T_odom_robot.heading_rad + turn_rad)};
}

/// What became of a reading of the wheels.
enum class OdometryVerdict : std::uint8_t {
  kFirst,       ///< nothing to compare it with
  kStep,        ///< step() is new
  kGap,         ///< too long after the last for the counters to be trusted: begun anew
  kJump,        ///< farther from the last than the robot can have driven: begun anew
  kOutOfOrder,  ///< not later than the last: not used
};

}  // namespace roomwise::create
