#include "services/ekf_svc/core/lost_monitor.h"

#include <algorithm>

namespace roomwise::ekf {

void LostMonitor::record(std::int64_t map_id, bool is_seen) {
  promises_[next_] = {map_id, is_seen};
  next_ = (next_ + 1) % kWindow;
  count_ = std::min(count_ + 1, kWindow);
}

bool LostMonitor::says_lost() const {
  if (count_ < kWindow) return false;
  std::size_t broken = 0;
  std::size_t landmarks = 0;
  for (std::size_t i = 0; i < kWindow; ++i) {
    if (promises_[i].is_kept) continue;
    ++broken;
    const auto is_same = [&](const Promise& p) {
      return !p.is_kept && p.map_id == promises_[i].map_id;
    };
    const auto here = promises_.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::none_of(promises_.begin(), here, is_same)) ++landmarks;
  }
  return 6 * broken >= 5 * kWindow && landmarks >= kLandmarksMin;
}

}  // namespace roomwise::ekf
