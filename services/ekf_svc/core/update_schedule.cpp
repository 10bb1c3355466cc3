#include "services/ekf_svc/core/update_schedule.h"

#include <cmath>

namespace roomwise::ekf {

void UpdateSchedule::moved(const MotionIncrement& motion, Time now) {
  travel_m_ += motion.translation_m.norm();
  turn_rad_ += std::abs(motion.turn_rad);
  if (has_moved()) last_motion_ = now;
}

bool UpdateSchedule::is_due(Time now) const {
  if (!has_updated_ || has_moved()) return true;
  if (seconds(now - last_motion_) > params_.parked_after_s) return false;
  return seconds(now - last_update_) >= params_.update_interval_s;
}

void UpdateSchedule::updated(Time now) {
  if (!has_updated_) last_motion_ = now;
  has_updated_ = true;
  travel_m_ = turn_rad_ = 0.0;
  last_update_ = now;
}

}  // namespace roomwise::ekf
