#include "services/safety_svc/core/estop_latch.h"

#include <algorithm>

#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {

void EstopLatch::press(const Instant& now, bool is_held) {
  held_until_ = is_held ? now.steady + kEstopHeld : now.steady;
  if (is_latched()) return;
  // Of the clock, so that the reset of a stop before a restart does not fit the one after it.
  last_id_ = std::max(last_id_ + 1, utime_of(now.wall));
  latch_id_ = last_id_;
}

ResetResult EstopLatch::reset(const Instant& now, std::int64_t latch_id, bool is_calm) {
  if (!is_latched()) return ResetResult::kNotLatched;
  if (latch_id != latch_id_) return ResetResult::kOtherLatch;
  if (now.steady < held_until_) return ResetResult::kStillHeld;
  if (!is_calm) return ResetResult::kNotCalm;
  latch_id_ = 0;
  return ResetResult::kReset;
}

}  // namespace roomwise::safety
