#pragma once
#include <optional>

#include "services/pilot_svc/core/goal.h"
#include "services/pilot_svc/core/surroundings.h"

namespace roomwise::pilot {

/// Notices that the robot does not get on: it is asked to drive and stands for `stuck_after_s`, or
/// has not left its place for four times as long.
class StuckWatch {
 public:
  explicit StuckWatch(const PilotParams& params) : params_(params) {}

  void forget() { place_.reset(); }
  bool is_stuck(Time now, const Pose2& T_odom_robot, const Motion& asked);

 private:
  PilotParams params_;
  std::optional<Eigen::Vector2d> place_;  // odom frame
  Time since_{};                          // at that place
  Time still_since_{};                    // asked for no speed until then
};

/// What it then does: stops, backs off a little where it came from, turns away, a quarter turn more
/// each time. Counted; a metre away from the place the count starts anew.
class Recovery {
 public:
  explicit Recovery(const PilotParams& params) : params_(params) {}

  /// False if recoveries are used up.
  [[nodiscard]] bool begin(Time now, const Pose2& T_odom_robot);
  bool is_on() const { return phase_ != Phase::kOff; }
  Motion step(Time now, const Pose2& T_odom_robot);
  /// All recoveries since the start.
  int count() const { return count_; }

 private:
  enum class Phase : std::uint8_t { kOff, kStop, kBackOff, kTurn };
  void enter(Phase phase, Time now);

  PilotParams params_;
  Phase phase_ = Phase::kOff;
  Time entered_{};
  std::optional<Pose2> began_at_;
  double heading_rad_ = 0.0;  // to turn to
  int count_ = 0;
  int in_a_row_ = 0;
};

}  // namespace roomwise::pilot
