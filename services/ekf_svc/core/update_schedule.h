#pragma once
#include "common/time.h"
#include "services/ekf_svc/core/ekf_params.h"
#include "services/ekf_svc/core/motion.h"

namespace roomwise::ekf {

/// When landmarks already mapped may be measured again. A detector's errors repeat from frame to
/// frame while the robot hardly moves; measuring 30 times a second from one place would count one
/// error as thirty, and a parked robot would become ever surer of it.
class UpdateSchedule {
 public:
  explicit UpdateSchedule(const EkfParams& params) : params_(params) {}

  /// The robot moved, until `now`.
  void moved(const MotionIncrement& motion, Time now);

  /// True after enough travel, turn or time since the last update; false for a parked robot.
  bool is_due(Time now) const;

  /// An update was made.
  void updated(Time now);

  /// Time starts anew.
  void restart() { *this = UpdateSchedule(params_); }

 private:
  bool has_moved() const {
    return travel_m_ >= params_.update_travel_m || turn_rad_ >= params_.update_turn_rad;
  }

  EkfParams params_;
  bool has_updated_ = false;
  double travel_m_ = 0.0;  // since the last update
  double turn_rad_ = 0.0;
  Time last_update_{};
  Time last_motion_{};
};

}  // namespace roomwise::ekf
