#pragma once
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "services/ekf_svc/core/motion.h"
#include "services/ekf_svc/core/sighting.h"

namespace roomwise::ekf {

/// A square corridor with landmarks along both walls, driven round and round by a robot that looks
/// ahead through a narrow camera. Noise is exactly as told to the filter.
struct CorridorSettings {
  double side_m = 15.0;       ///< of the square the robot drives
  double half_width_m = 1.0;  ///< from its path to either wall
  double spacing_m = 1.2;     ///< of landmarks along a wall, with a third of it at random
  int classes = 1;            ///< kinds of landmarks the camera tells apart
  double step_m = 0.1;
  double distance_sigma_m = 0.005;  ///< per step
  double turn_sigma_rad = 0.25 * std::numbers::pi / 180.0;
  double range_sigma_m = 0.015;
  double bearing_sigma_rad = 0.25 * std::numbers::pi / 180.0;
  double range_max_m = 3.8;
  double half_view_rad = 28.5 * std::numbers::pi / 180.0;
  double missed_ratio = 0.0;                 ///< of sightings
  double clutter_per_frame = 0.0;            ///< things seen that are not there
  bool looks_the_same_turned_round = false;  ///< opposite sides alike, to the last landmark
};

class CorridorWorld {
 public:
  CorridorWorld(const CorridorSettings& settings, std::uint64_t seed);

  /// Drives one step and returns what the wheels say of it.
  MotionIncrement drive();

  struct Seen {
    int landmark;  ///< -1: clutter
    Sighting sighting;
  };
  std::vector<Seen> look();

  /// From a random place and heading on the course; in the world's frame.
  void start_anywhere();

  double lap_m() const;
  const Pose2& truth() const { return truth_; }
  const std::vector<Eigen::Vector2d>& landmarks() const { return landmarks_; }

 private:
  void line_with_landmarks(int side);
  Pose2 course(double way_m) const;
  Sighting sighting_at(const Eigen::Vector2d& p_robot_m, std::int8_t kind);

  CorridorSettings settings_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  std::vector<Eigen::Vector2d> landmarks_;
  std::vector<std::int8_t> kinds_;
  double along_m_ = 0.0;  // of the course, from its first corner
  Pose2 truth_;
};

}  // namespace roomwise::ekf
