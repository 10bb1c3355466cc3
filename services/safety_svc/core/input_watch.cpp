#include "services/safety_svc/core/input_watch.h"

#include <chrono>

namespace roomwise::safety {

StampResult InputWatch::hear(const Instant& now, Time measured) {
  if (measured > now.wall + kFutureSlack) {
    distrusted_until_ = now.steady + kDistrust;
    return StampResult::kFromFuture;
  }
  if (measured < now.wall - kStampAge) return StampResult::kOld;
  const bool was_set_back = newest_ > now.wall + kFutureSlack;
  if (measured <= newest_ && !was_set_back) return StampResult::kOutOfOrder;
  newest_ = measured;
  received_ = now.steady;
  return StampResult::kFresh;
}

bool InputWatch::is_fresh(const Instant& now, Duration age_max) const {
  return received_ && now.steady - *received_ <= age_max;
}

double InputWatch::age_s(const Instant& now) const {
  return received_ ? seconds(now.steady - *received_) : -1.0;
}

void ClockWatch::tick(const Instant& now) {
  if (last_) {
    const Duration step = (now.wall - last_->wall) - (now.steady - last_->steady);
    if (std::chrono::abs(step) > kClockStep) distrusted_until_ = now.steady + kDistrust;
  }
  last_ = now;
}

}  // namespace roomwise::safety
