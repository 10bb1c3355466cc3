#include "services/segment_svc/core/standing_surfaces.h"

#include <algorithm>
#include <cmath>

#include "common/multiversion.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr float kSame_quanta = 4.0F;  // a pixel against the surface above it
constexpr float kRowsAveraged = 10.0F;
constexpr float kRowsMin = 2.0F;
constexpr float kFoot_quanta = 0.75F;  // in doubt, of two that differ by less, the surface

struct FootRule {
  float rise;  // of the row
  float ahead;
  float per_height_m;  // 1 / the camera's height
  float same_per_m;
  float foot_per_m;
};

/// Choices one after another, no two in one condition: so the compiler makes selects of them and
/// runs many pixels at a time.
ROOMWISE_MULTIVERSION
void mark_row(const float* z_of_column_m, const float* rise_of_column, const float* ahead_of_column,
              FootRule rule, std::size_t width, float* __restrict surface_per_m,
              float* __restrict rows, std::int32_t* __restrict labels) {
  for (std::size_t u = 0; u < width; ++u) {
    const float surface = surface_per_m[u];
    const float above = rows[u];
    const std::int32_t label = labels[u];
    const float grown = above + 1.0F;
    const float count = grown < kRowsAveraged ? grown : kRowsAveraged;
    const float per_m = 1.0F / ((ahead_of_column[u] + rule.ahead) * z_of_column_m[u]);
    const float per_ahead = z_of_column_m[u] * per_m;
    const float floor_per_m = -(rise_of_column[u] + rule.rise) * rule.per_height_m * per_ahead;
    const float off = per_m - surface;

    int is_same = std::abs(off) <= rule.same_per_m * per_ahead ? 1 : 0;
    is_same = above > 0.0F ? is_same : 0;
    int is_foot = label == kAccessible ? is_same : 0;
    is_foot = above >= kRowsMin ? is_foot : 0;
    is_foot = surface + rule.foot_per_m * per_ahead > floor_per_m ? is_foot : 0;
    const int stands = label == kObstacle ? 1 : is_foot;

    float new_per_m = surface + off / count;
    new_per_m = is_foot != 0 ? surface : new_per_m;  // a foot says nothing new about its surface
    new_per_m = is_same != 0 ? new_per_m : per_m;
    float new_rows = is_same != 0 ? count : 1.0F;
    new_rows = stands != 0 ? new_rows : 0.0F;
    surface_per_m[u] = label == kUnknown ? surface : new_per_m;  // no reading ends nothing
    rows[u] = label == kUnknown ? above : new_rows;
    labels[u] = is_foot != 0 ? std::int32_t{kObstacle} : label;
  }
}

/// Depths that can be divided by, and labels, of a row.
ROOMWISE_MULTIVERSION
void widen(const std::uint16_t* steps, float unit_m, const std::uint8_t* labels, std::size_t width,
           float* __restrict z_m, std::int32_t* __restrict wide_labels) {
  for (std::size_t u = 0; u < width; ++u) {
    const int step = steps[u] > 0 ? steps[u] : 1;
    z_m[u] = unit_m * static_cast<float>(step);
  }
  for (std::size_t u = 0; u < width; ++u) wide_labels[u] = labels[u];
}

ROOMWISE_MULTIVERSION
void narrow(const std::int32_t* wide_labels, std::size_t width, std::uint8_t* __restrict labels) {
  for (std::size_t u = 0; u < width; ++u) labels[u] = static_cast<std::uint8_t>(wide_labels[u]);
}

/// So far above the first row whose rays meet the floor that a surface's mean has settled there.
std::size_t first_row(const CameraView& view, const Eigen::Vector3f& n) {
  constexpr float kRowsBefore = 3.0F * kRowsAveraged;
  const float edge_rise = std::max(-n.x() * view.ray_x().front(), -n.x() * view.ray_x().back());
  const auto meets_floor = [&](float y) { return n.y() * y + n.z() < edge_rise; };
  const auto first = std::find_if(view.ray_y().begin(), view.ray_y().end(), meets_floor);
  const auto row = static_cast<float>(first - view.ray_y().begin());
  return static_cast<std::size_t>(std::max(0.0F, row - kRowsBefore));
}

}  // namespace

void StandingSurfaces::mark(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
                            std::vector<std::uint8_t>& labels) {
  const auto width = static_cast<std::size_t>(view.width_px());
  const Eigen::Vector3f n = floor.normal.cast<float>();
  const Eigen::Vector3f d = (Eigen::Vector3f::UnitZ() - n.z() * n).normalized();
  rise_of_column_.resize(width);
  ahead_of_column_.resize(width);
  for (std::size_t u = 0; u < width; ++u) {
    rise_of_column_[u] = n.x() * view.ray_x()[u];
    ahead_of_column_[u] = d.x() * view.ray_x()[u];
  }
  surface_per_m_.assign(width, 0.0F);
  rows_.assign(width, 0.0F);
  z_m_.resize(width);
  label_.resize(width);
  for (std::size_t v = first_row(view, n); v < static_cast<std::size_t>(view.height_px()); ++v) {
    const float y = view.ray_y()[v];
    std::uint8_t* row = labels.data() + v * width;
    widen(frame.depth.steps.data() + v * width, static_cast<float>(view.unit_m()), row, width,
          z_m_.data(), label_.data());
    mark_row(z_m_.data(), rise_of_column_.data(), ahead_of_column_.data(),
             {.rise = n.y() * y + n.z(),
              .ahead = d.y() * y + d.z(),
              .per_height_m = static_cast<float>(1.0 / floor.height_m),
              .same_per_m = kSame_quanta * view.quantum_per_m(),
              .foot_per_m = kFoot_quanta * view.quantum_per_m()},
             width, surface_per_m_.data(), rows_.data(), label_.data());
    narrow(label_.data(), width, row);
  }
}

}  // namespace roomwise::segment
