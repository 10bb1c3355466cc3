#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/ekf_svc/core/body_observation.h"
#include "services/ekf_svc/core/motion.h"

namespace roomwise::ekf {

/// A robot on a round course between point landmarks, with noise exactly as it tells the filter.
struct WorldSettings {
  int landmarks = 60;
  double course_radius_m = 4.0;
  double landmark_ring_m = 3.0;  ///< landmarks lie this far from the course at most
  double step_m = 0.1;
  double distance_sigma_m = 0.005;  ///< per step
  double turn_sigma_rad = 0.01;
  double range_sigma_m = 0.015;
  double bearing_sigma_rad = 0.0044;
  double range_max_m = 3.8;
  double half_view_rad = 28.5 * std::numbers::pi / 180.0;
};

class SimulatedWorld {
 public:
  struct Seen {
    int id;
    PolarObservation polar;
  };

  SimulatedWorld(const WorldSettings& settings, std::uint64_t seed)
      : settings_(settings), engine_(seed) {
    // The course starts at the map's origin, heading along x; its centre is to the left.
    std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
    std::uniform_real_distribution<double> offset(-settings.landmark_ring_m,
                                                  settings.landmark_ring_m);
    for (int i = 0; i < settings.landmarks; ++i) {
      const double a = angle(engine_);
      const double r = settings.course_radius_m + offset(engine_);
      landmarks_.emplace_back(r * std::cos(a), settings.course_radius_m + r * std::sin(a));
    }
  }

  /// Drives one step and returns what the wheels say of it.
  MotionStep drive() {
    const double turn = settings_.step_m / settings_.course_radius_m;
    MotionIncrement motion;
    motion.append(arc_step(settings_.step_m, turn, Eigen::Matrix2d::Zero()));
    truth_ = moved(truth_, motion);
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    covariance(0, 0) = settings_.distance_sigma_m * settings_.distance_sigma_m;
    covariance(1, 1) = settings_.turn_sigma_rad * settings_.turn_sigma_rad;
    return arc_step(settings_.step_m + settings_.distance_sigma_m * normal_(engine_),
                    turn + settings_.turn_sigma_rad * normal_(engine_), covariance);
  }

  /// What the camera sees from where the robot is.
  std::vector<Seen> look() {
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector2d p = transform(inverse(truth_), landmarks_[i]);
      const double bearing = std::atan2(p.y(), p.x());
      if (p.norm() > settings_.range_max_m || p.norm() < 0.3) continue;
      if (std::abs(bearing) > settings_.half_view_rad) continue;
      PolarObservation polar;
      polar.range_m = p.norm() + settings_.range_sigma_m * normal_(engine_);
      polar.bearing_rad = bearing + settings_.bearing_sigma_rad * normal_(engine_);
      polar.covariance(0, 0) = settings_.range_sigma_m * settings_.range_sigma_m;
      polar.covariance(1, 1) = settings_.bearing_sigma_rad * settings_.bearing_sigma_rad;
      seen.push_back({static_cast<int>(i), polar});
    }
    return seen;
  }

  const Pose2& truth() const { return truth_; }
  const std::vector<Eigen::Vector2d>& landmarks() const { return landmarks_; }

 private:
  WorldSettings settings_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::Vector2d> landmarks_;
  Pose2 truth_;
};

}  // namespace roomwise::ekf
