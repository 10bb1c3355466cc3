#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <vector>

#include "common/bus/log_event.h"
#include "common/geometry/pose2.h"

namespace roomwise::mrclam {

/// One robot's run of the UTIAS MRCLAM data set (Leung et al., IJRR 2011).
struct Run {
  std::vector<LogEvent> events;                       ///< ODOMETRY and LANDMARKS, in order of time
  std::map<std::int64_t, Pose2> truth;                ///< by utime
  std::map<std::int32_t, Eigen::Vector2d> landmarks;  ///< by subject
};

/// What the messages' covariances are made of.
struct Noise {
  double distance_m2_per_m = 0.005;
  double turn_rad2_per_rad = 0.02;
  double turn_rad2_per_m = 0.01;
  double range_m = 0.10;
  double range_ratio = 0.03;
  double bearing_rad = 0.03;
  double odometry_delay_s = 0.25;  ///< the recorded speeds are commands; the robot follows later
};

/// Speeds are held until the next line. Sightings of one instant are one LANDMARKS message; those
/// of other robots are left out.
Run read(const std::filesystem::path& folder, int robot, const Noise& noise = {});

/// Truth at `utime`, linear between its neighbours; false outside.
bool truth_at(const Run& run, std::int64_t utime, Pose2& pose);

/// Rigid motion (no scale) that brings `from` nearest to `to`, least squares.
Pose2 rigid_fit(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to);

/// Root mean square distance after that motion.
double aligned_rmse(const std::vector<Eigen::Vector2d>& from,
                    const std::vector<Eigen::Vector2d>& to);

}  // namespace roomwise::mrclam
