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
  float unit_m;
  float per_height_m;  // 1 / the camera's height
  float same_per_m;
  float foot_per_m;
};

ROOMWISE_MULTIVERSION
void mark_row(const std::uint16_t* steps, const float* rise_of_column, const float* ahead_of_column,
              FootRule rule, std::size_t width, float* surface_per_m, float* rows,
              std::uint8_t* labels) {
  for (std::size_t u = 0; u < width; ++u) {
    const float per_ahead = 1.0F / (ahead_of_column[u] + rule.ahead);
    const float z_m = rule.unit_m * static_cast<float>(steps[u] > 0 ? steps[u] : 1);
    const float per_m = per_ahead / z_m;
    const float floor_per_m = -(rise_of_column[u] + rule.rise) * rule.per_height_m * per_ahead;
    const int label = labels[u];
    const float off = std::abs(per_m - surface_per_m[u]);
    const float same = rule.same_per_m * per_ahead;
    const int is_same = static_cast<int>(off <= same) & static_cast<int>(rows[u] > 0.0F);
    const int is_foot =
        static_cast<int>(label == kAccessible) & is_same & static_cast<int>(rows[u] >= kRowsMin) &
        static_cast<int>(surface_per_m[u] + rule.foot_per_m * per_ahead > floor_per_m);
    const int stands = static_cast<int>(label == kObstacle) | is_foot;
    // A foot says nothing new about its surface.
    const float grown = rows[u] + 1.0F;
    const float count = grown < kRowsAveraged ? grown : kRowsAveraged;
    const float mean = surface_per_m[u] + (per_m - surface_per_m[u]) / count;
    const float kept = is_foot != 0 ? surface_per_m[u] : mean;
    const float new_per_m = is_same != 0 ? kept : per_m;
    surface_per_m[u] = label != kUnknown ? new_per_m : surface_per_m[u];  // ends nothing
    const float kept_rows = is_same != 0 ? count : 1.0F;
    const float new_rows = stands != 0 ? kept_rows : 0.0F;
    rows[u] = label != kUnknown ? new_rows : rows[u];
    labels[u] = static_cast<std::uint8_t>(is_foot != 0 ? static_cast<int>(kObstacle) : label);
  }
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
  for (std::size_t v = 0; v < static_cast<std::size_t>(view.height_px()); ++v) {
    const float y = view.ray_y()[v];
    mark_row(frame.depth.steps.data() + v * width, rise_of_column_.data(), ahead_of_column_.data(),
             {.rise = n.y() * y + n.z(),
              .ahead = d.y() * y + d.z(),
              .unit_m = static_cast<float>(view.unit_m()),
              .per_height_m = static_cast<float>(1.0 / floor.height_m),
              .same_per_m = kSame_quanta * view.quantum_per_m(),
              .foot_per_m = kFoot_quanta * view.quantum_per_m()},
             width, surface_per_m_.data(), rows_.data(), labels.data() + v * width);
  }
}

}  // namespace roomwise::segment
