#pragma once
#include "common/bus/bus.h"
#include "services/pilot_svc/core/pilot.h"

namespace roomwise {

/// PILOT_GOAL, SEGMENTS, ODOMETRY, POSE and SAFETY_STATE in; VEL_REQUEST at 20 Hz while there is a
/// goal and PILOT_STATE at 5 Hz and on change out.
///
/// Time is that of ODOMETRY, or of SEGMENTS and POSE when odometry falls silent: what is published
/// depends on the messages and their order alone. When all are silent nothing is published, and the
/// last request dies.
class PilotService {
 public:
  using Params = pilot::PilotParams;
  PilotService(Bus& bus, const Params& params);

 private:
  void on_goal(const pilot_goal_t& message);
  void on_odometry(const odometry_t& message);
  void on_segments(const segmentation_t& message);
  void on_pose(const pose_t& message);
  void count(std::string_view input, pilot::InputResult result);
  void advance(Time time);
  void publish_request(Time time, const pilot::Motion& motion);
  void publish_state(Time time);

  Bus& bus_;
  pilot::Pilot pilot_;
  Duration request_life_;
  Time now_{};  // of the data
  Time state_published_{};
  pilot::State state_ = pilot::State::kIdle;
  std::int64_t goal_utime_ = 0;
  bool has_goal_ = false;
};

}  // namespace roomwise
