#include "services/simulator/core/kinect/projector_shadow.h"

#include <algorithm>
#include <cmath>

namespace roomwise::simulator {
namespace {

constexpr int kBeyond_px = 512;  // disparities larger than that take part with this one
constexpr float kStepLeast_px = 1.0F;

/// Column of nearest_ that lights a surface of `disparity_px` seen at `u`, rounded down.
std::size_t projector_column(std::size_t u, float disparity_px) {
  const float clamped = std::min(disparity_px, static_cast<float>(kBeyond_px - 1));
  return static_cast<std::size_t>(static_cast<float>(u) + static_cast<float>(kBeyond_px) - clamped);
}

}  // namespace

void ProjectorShadow::resize(int width_px) {
  nearest_.assign(static_cast<std::size_t>(width_px + kBeyond_px) + 2, 0.0F);
}

bool ProjectorShadow::has_step(std::span<const float> row, float step) const {
  float largest = 0.0F;
  for (std::size_t u = 1; u < row.size(); ++u) {
    largest = std::max(largest, row[u - 1] * row[u] > 0.0F ? row[u] - row[u - 1] : 0.0F);
  }
  // A hole between two surfaces may hide a step.
  return largest >= step || std::find(row.begin(), row.end(), 0.0F) != row.end();
}

void ProjectorShadow::apply(std::span<float> row, float px_per_unit) {
  const float step = kStepLeast_px / px_per_unit;
  if (!has_step(row, step)) return;
  std::fill(nearest_.begin(), nearest_.end(), 0.0F);
  for (std::size_t u = 0; u < row.size(); ++u) {
    if (row[u] == 0.0F) continue;
    const std::size_t p = projector_column(u, row[u] * px_per_unit);
    nearest_[p] = std::max(nearest_[p], row[u]);
    nearest_[p + 1] = std::max(nearest_[p + 1], row[u]);
  }
  for (std::size_t u = 0; u < row.size(); ++u) {
    if (row[u] == 0.0F) continue;
    const std::size_t p = projector_column(u, row[u] * px_per_unit);
    if (std::min(nearest_[p], nearest_[p + 1]) >= row[u] + step) row[u] = 0.0F;
  }
}

}  // namespace roomwise::simulator
