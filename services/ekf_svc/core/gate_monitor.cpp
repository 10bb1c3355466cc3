#include "services/ekf_svc/core/gate_monitor.h"

#include <algorithm>

namespace roomwise::ekf {

void GateMonitor::record(std::int64_t map_id, bool accepted) {
  answers_[next_] = {map_id, accepted};
  next_ = (next_ + 1) % kWindow;
  count_ = std::min(count_ + 1, kWindow);
}

bool GateMonitor::pose_is_doubtful() const {
  if (count_ < kEvidence) return false;
  std::size_t refused = 0;
  bool several = false;
  std::int64_t first = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (answers_[i].accepted) continue;
    if (refused++ == 0) first = answers_[i].map_id;
    several = several || answers_[i].map_id != first;
  }
  return several && 2 * refused > count_;
}

bool GateMonitor::others_are_accepted(std::int64_t map_id) const {
  std::size_t others = 0;
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (answers_[i].map_id == map_id) continue;
    ++others;
    if (answers_[i].accepted) ++accepted;
  }
  return accepted > 0 && 2 * accepted > others;
}

}  // namespace roomwise::ekf
