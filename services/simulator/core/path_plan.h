#pragma once
#include <vector>

#include "common/geometry/pose2.h"
#include "services/simulator/core/path_profile.h"
#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// How fast a robot follows a path.
struct DriveLimits {
  double speed_mps = 0.25;
  double acceleration_mps2 = 0.25;
  double turn_radps = 0.8;
  double turn_acceleration_radps2 = 1.6;
};

/// Where the robot is to be at one instant, and how it moves then.
struct DriveMoment {
  Pose2 pose;
  double speed_mps = 0.0;
  double turn_radps = 0.0;
};

/// A path as a function of time, without jumps of place, speed or turn rate: straight legs, joined
/// by curves driven at full speed on which the turn rate rises, holds and falls (two clothoids with
/// an arc between them); where a curve does not fit, or turns by more than 2.2 rad, the robot stops
/// and turns on the spot. It begins and ends at rest in Scene::start.
class DrivePlan {
 public:
  /// Throws std::invalid_argument if two corners in a row are the same place.
  DrivePlan(const Pose2& start, const Path& path, const DriveLimits& limits = {});

  double duration_s() const;
  double length_m() const;  ///< of the way driven

  /// At `t_s` after the start; at rest before it and after the end. O(log of the corners).
  DriveMoment at(double t_s) const;

 private:
  enum class Kind { kStraight, kCurve, kSpot };
  struct Piece {
    Kind kind;
    Pose2 from;
    double sense;          ///< +1 to the left, -1 to the right; unused when straight
    SpeedProfile profile;  ///< metres when straight, otherwise radians
    double start_s;
  };

  void add(Kind kind, const Pose2& from, double sense, const SpeedProfile& profile);
  void add_spot(const Pose2& from, double turn_rad);
  void add_legs(const std::vector<Eigen::Vector2d>& nodes_m);
  Pose2 pose_in(const Piece& piece, double into_s, double way) const;

  DriveLimits limits_;
  std::vector<Piece> pieces_;
};

}  // namespace roomwise::simulator
