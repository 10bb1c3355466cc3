#pragma once
#include <Eigen/Core>
#include <vector>

#include "services/safety_svc/core/decide.h"

namespace roomwise::safety {

/// A robot that does what it is allowed, among round obstacles taller than itself, with an ideal
/// camera: 57 degrees wide, floor in view from 0.75 m on, 30 frames a second. The test may change
/// any field between steps.
class DrivenWorld {
 public:
  struct Disc {
    Eigen::Vector2d p_m;
    double radius_m = 0.1;
  };
  static constexpr Duration kTick = std::chrono::milliseconds(20);
  static constexpr double kSeenFrom_m = 0.75;

  DrivenWorld();

  /// Hears everything that is on, decides, moves for one tick. The decision.
  Decision step();
  /// Steps until `time` has gone by; the last decision.
  Decision run(Duration time);
  void ask(double speed_mps, double turn_rate_radps) { request = {speed_mps, turn_rate_radps}; }
  /// Hears what is asked, and nothing else; no time goes by.
  void hear_request();

  /// From the robot's edge to the nearest obstacle's.
  double clearance_m() const;
  Instant now() const { return now_; }
  FloorView view() const;
  OdometrySample odometry_sample() const;

  SafetyParams params;
  World world{params};
  std::vector<Disc> discs;
  Pose2 T_odom_robot;
  Request request;
  BodyState body{.is_in_driving_mode = true};
  bool asks = true;
  bool has_camera = true;
  bool has_frames = true;  ///< of the camera; else its views alone are heard
  bool has_odometry = true;
  bool has_body = true;
  int odometry_resets = 0;     ///< odom frames before this one
  Duration stamp_ahead{};      ///< added to every stamp
  double dark_within_m = 0.0;  ///< no readings at all of what is nearer
  Granted granted;

  static CameraSetup camera();

 private:
  void hear();
  /// To the nearest disc along the bearing, or where sight ends.
  double sight_m(double bearing_rad) const;

  Instant now_{std::chrono::hours(1), time_from_utime(1'700'000'000'000'000)};
  int ticks_ = 0;
  Request moved_;  // over the last tick
  std::vector<double> free_m_;
  std::vector<double> unknown_;
  std::vector<double> obstacle_m_;
};

}  // namespace roomwise::safety
