#pragma once
#include "services/simulator/core/left_right.h"
#include "services/simulator/core/path_plan.h"

namespace roomwise::simulator {

/// How hard a follower corrects, and what it may ask for.
struct FollowerGains {
  double along_per_s = 1.0;     ///< speed per metre behind the plan
  double across_per_m2 = 16.0;  ///< turn per metre beside it and metre driven
  double heading_per_s = 2.0;   ///< turn rate per radian of heading error
  double patience_m = 0.3;      ///< so far behind, the plan waits
  double largest_wheel_mps = 0.5;
};

/// Drives a robot along a plan from its true pose, for recordings that need no navigation: the plan
/// runs in time, but waits for a robot that falls behind by more than a third of `patience_m`, and
/// the robot tracks the moving pose.
///
/// Source: Kanayama, Kimura, Miyazaki, Noguchi, "A stable tracking control method for an autonomous
/// mobile robot" (ICRA 1990): v = v_r cos(e_h) + k_x e_x, w = w_r + v_r k_y e_y + k_h sin(e_h).
class PathFollower {
 public:
  PathFollower(DrivePlan plan, double wheel_base_m, const FollowerGains& gains = {});

  /// Rim speeds for the next `dt_s`, with the robot at `T_world_robot`. Beyond the largest wheel
  /// speed both wheels slow by one factor, so that the curvature stays. Zero once done.
  LeftRight<double> step(const Pose2& T_world_robot, double dt_s);

  /// The plan has come to its end and the robot to within 5 cm and 0.05 rad of it, or a second has
  /// passed since.
  bool done() const { return done_; }
  double plan_time_s() const { return plan_s_; }
  const DrivePlan& plan() const { return plan_; }

 private:
  void advance(const Pose2& T_robot_goal, double dt_s);

  DrivePlan plan_;
  double wheel_base_m_;
  FollowerGains gains_;
  double plan_s_ = 0.0;
  double settling_s_ = 0.0;
  bool done_ = false;
};

}  // namespace roomwise::simulator
