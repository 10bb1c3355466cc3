#include "services/segment_svc/core/corridor.h"

#include <cmath>
#include <numeric>

#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr double kBin_m = 0.01;
constexpr double kNearShare = 0.02;

}  // namespace

Corridor::Corridor(const SegmentParams& params)
    : half_width_m_(static_cast<float>(0.5 * params.robot_width_m + params.corridor_margin_m)),
      length_m_(static_cast<float>(params.corridor_length_m)),
      robot_height_m_(static_cast<float>(params.robot_height_m)) {}

void Corridor::begin() {
  blocked_.fill(0);
  unknown_ = 0;
  known_ = 0;
}

void Corridor::add(const GroundRow& row) {
  for (std::size_t i = 0; i < row.x_m.size(); ++i) {
    const float x_m = row.x_m[i];
    if (std::abs(row.y_m[i]) > half_width_m_ || !(x_m > 0.0F)) continue;
    const bool is_unknown = row.label[i] == kUnknown;
    if (x_m <= length_m_) ++(is_unknown ? unknown_ : known_);
    if (is_unknown || row.label[i] == kAccessible || row.height_m[i] > robot_height_m_) continue;
    const float cell = x_m * static_cast<float>(1.0 / kBin_m);
    if (cell < static_cast<float>(kCells)) ++blocked_[static_cast<std::size_t>(cell)];
  }
}

CorridorView Corridor::end() const {
  const int looked = unknown_ + known_;
  return {.near_m = near_quantile_m(),
          .unknown_ratio = looked > 0 ? static_cast<double>(unknown_) / looked : 1.0};
}

double Corridor::near_quantile_m() const {
  const int total = std::accumulate(blocked_.begin(), blocked_.end(), 0);
  if (total == 0) return 0.0;
  int nearer = 0;
  std::size_t cell = 0;
  while ((nearer += blocked_[cell]) <= kNearShare * total) ++cell;
  return (static_cast<double>(cell) + 0.5) * kBin_m;
}

}  // namespace roomwise::segment
