#pragma once
#include <functional>

#include "tests/pilot_svc/support/kinematic_world.h"

namespace roomwise::pilot {

/// A pilot at the wheel of a flat world: frames at 10 Hz, odometry and ticks at 20 Hz, a perfect
/// POSE (map is where the robot started).
class PilotDrive {
 public:
  PilotDrive(KinematicWorld& world, const Goal& goal, const PilotParams& params = {});

  /// Until the pilot has done or failed, at most so long; `watch` is called after every step.
  void run(
      double seconds_max, const std::function<void()>& watch = [] {});

  const Report& report() const { return pilot_.report(); }
  /// Times the turn rate changed sign from more than 0.3 rad/s within a second.
  int dithers() const { return dithers_; }

 private:
  void step();
  void watch_turns(const Motion& motion);

  KinematicWorld& world_;
  Pose2 T_world_map_;
  Pilot pilot_;
  long steps_ = 0;
  int dithers_ = 0;
  double turned_s_ = -10.0;  // last turn faster than 0.3 rad/s
  double turned_radps_ = 0.0;
};

}  // namespace roomwise::pilot
