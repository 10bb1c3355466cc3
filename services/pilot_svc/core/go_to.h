#pragma once
#include "services/pilot_svc/core/direction_choice.h"
#include "services/pilot_svc/core/goal.h"

namespace roomwise::pilot {

/// Drives to a point: straight where the way is free, else along the direction that leads nearest
/// to it. Fails with kNoWay if it has come no nearer for `no_nearer_s`.
class GoTo {
 public:
  GoTo(const Goal& goal, const PilotParams& params);

  /// `goal_odom_m`: the point, in the odom frame as of now.
  Step step(const Surroundings& around, const Eigen::Vector2d& goal_odom_m);

  double distance_m() const { return distance_m_; }
  /// Share of the first distance that is behind it.
  double ratio() const;

 private:
  PilotParams params_;
  double speed_mps_;
  DirectionChoice choice_;
  double first_m_ = -1.0;  // distance at the start; -1: not known yet
  double nearest_m_ = 0.0;
  Time nearest_when_{};
  double distance_m_ = 0.0;
};

}  // namespace roomwise::pilot
