#include "services/simulator/core/kinect/projector_shadow.h"

#include <algorithm>

#include "common/multiversion.h"

namespace roomwise::simulator {
namespace {

constexpr int kBeyond_px = 512;  // disparities larger than that take part with this one
constexpr float kStepLeast_px = 1.0F;

/// Projector column, counted from -kBeyond_px and rounded down, that lights each pixel. Returns
/// whether one column lights two of them, or there is a hole that may hide that it does.
ROOMWISE_MULTIVERSION
int find_columns(const float* row, float px_per_unit, int width, std::int32_t* column) {
  constexpr auto kMost_px = static_cast<float>(kBeyond_px - 1);
  for (int u = 0; u < width; ++u) {
    const float raw_px = row[u] * px_per_unit;
    const float disparity_px = raw_px < kMost_px ? raw_px : kMost_px;
    column[u] = static_cast<std::int32_t>(static_cast<float>(u + kBeyond_px) - disparity_px);
  }
  int any = static_cast<int>(row[0] == 0.0F);
  for (int u = 1; u < width; ++u) {
    any |= static_cast<int>(column[u] < column[u - 1]) | static_cast<int>(row[u] == 0.0F);
  }
  return any;
}

/// Sets to 0 what something nearer by `step` or more keeps in the dark.
ROOMWISE_MULTIVERSION
void darken(const float* nearest, const std::int32_t* column, float step, int width, float* row) {
  for (int u = 0; u < width; ++u) {
    const float first = nearest[column[u]], second = nearest[column[u] + 1];
    const float lit = first < second ? first : second;
    row[u] = lit >= row[u] + step ? 0.0F : row[u];
  }
}

}  // namespace

void ProjectorShadow::resize(int width_px) {
  nearest_.assign(static_cast<std::size_t>(width_px + kBeyond_px) + 2, 0.0F);
  column_.assign(static_cast<std::size_t>(width_px), 0);
}

void ProjectorShadow::apply(std::span<float> row, float px_per_unit) {
  const auto width = static_cast<int>(row.size());
  if (find_columns(row.data(), px_per_unit, width, column_.data()) == 0) return;
  std::fill(nearest_.begin(), nearest_.end(), 0.0F);
  for (std::size_t u = 0; u < row.size(); ++u) {
    float* const lit = nearest_.data() + column_[u];
    lit[0] = std::max(lit[0], row[u]);
    lit[1] = std::max(lit[1], row[u]);
  }
  darken(nearest_.data(), column_.data(), kStepLeast_px / px_per_unit, width, row.data());
}

}  // namespace roomwise::simulator
