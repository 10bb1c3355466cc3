#include "services/pilot_svc/core/visit_memory.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {

void VisitMemory::forget() { std::fill(cells_.begin(), cells_.end(), Cell{}); }

void VisitMemory::visit(Time now, const Eigen::Vector2d& p_odom_m) {
  const Cell cell = cell_at(now, p_odom_m);
  cells_[slot_of(cell)] = cell;
}

double VisitMemory::freshness(Time now, const Eigen::Vector2d& p_odom_m, double fades_s) const {
  const Cell asked = cell_at(now, p_odom_m);
  const Cell& cell = cells_[slot_of(asked)];
  if (cell.column != asked.column || cell.row != asked.row) return 0.0;
  return std::exp(-std::max(seconds(now - cell.visited), 0.0) / fades_s);
}

VisitMemory::Cell VisitMemory::cell_at(Time now, const Eigen::Vector2d& p_odom_m) {
  constexpr double kSquare_m = 0.5;
  const auto index = [](double at_m) {
    return static_cast<std::int32_t>(std::floor(std::clamp(at_m, -1e7, 1e7) / kSquare_m));
  };
  return {index(p_odom_m.x()), index(p_odom_m.y()), now};
}

std::size_t VisitMemory::slot_of(const Cell& cell) {
  const auto wrapped = [](std::int32_t i) {
    return static_cast<std::size_t>((i % kSide + kSide) % kSide);
  };
  return wrapped(cell.row) * kSide + wrapped(cell.column);
}

}  // namespace roomwise::pilot
