#include "services/segment_svc/core/view_distances.h"

#include <algorithm>

#include "common/multiversion.h"

namespace roomwise::segment {
namespace {

/// Of one row: at most 4096 pixels of 65535 steps, so 32 bits are enough.
struct RowSum {
  std::uint32_t pixels = 0;
  std::uint32_t readings = 0;
  std::uint32_t steps = 0;
};

/// 16 bits hold a row's counts, and let 16 pixels be counted at a time.
ROOMWISE_MULTIVERSION
void sum_row(const std::uint16_t* steps, const std::uint8_t* labels, std::size_t width,
             std::uint8_t label, std::uint16_t far_steps, RowSum& sum) {
  std::uint16_t pixels = 0;
  std::uint16_t readings = 0;
  std::uint32_t total = 0;
  for (std::size_t u = 0; u < width; ++u) {
    const std::uint16_t is_of_class = labels[u] == label ? 0xffff : 0;
    const std::uint16_t near = steps[u] <= far_steps ? steps[u] : 0;
    const auto kept = static_cast<std::uint16_t>(near & is_of_class);
    pixels = static_cast<std::uint16_t>(pixels - is_of_class);  // all ones is -1
    readings = static_cast<std::uint16_t>(readings + (kept > 0 ? 1 : 0));
    total += kept;
  }
  sum = {.pixels = pixels, .readings = readings, .steps = total};
}

/// Most rows show two or three classes.
ROOMWISE_MULTIVERSION
bool has_label(const std::uint8_t* labels, std::size_t width, std::uint8_t label) {
  std::uint8_t found = 0;
  for (std::size_t u = 0; u < width; ++u) {
    found = static_cast<std::uint8_t>(found | (labels[u] == label ? 1 : 0));
  }
  return found != 0;
}

struct ClassSum {
  std::int64_t pixels = 0;
  std::int64_t readings = 0;
  std::int64_t steps = 0;
};

double mean_m(const ClassSum& sum, double unit_m) {
  if (sum.readings == 0) return 0.0;
  return unit_m * static_cast<double>(sum.steps) / static_cast<double>(sum.readings);
}

}  // namespace

ViewDistances measure_distances(const DepthImage& depth, double range_max_m,
                                const std::vector<std::uint8_t>& labels) {
  const auto width = static_cast<std::size_t>(depth.width_px);
  const auto far_steps = static_cast<std::uint16_t>(std::min(65535.0, range_max_m / depth.unit_m));
  std::array<ClassSum, kLabels.size()> sums{};
  RowSum row;
  for (std::size_t first = 0; first < labels.size(); first += width) {
    for (std::size_t k = 0; k < kLabels.size(); ++k) {
      if (!has_label(labels.data() + first, width, kLabels[k])) continue;
      sum_row(depth.steps.data() + first, labels.data() + first, width, kLabels[k], far_steps, row);
      sums[k].pixels += row.pixels;
      sums[k].readings += row.readings;
      sums[k].steps += row.steps;
    }
  }
  ViewDistances distances;
  ClassSum all;
  for (std::size_t k = 0; k < kLabels.size(); ++k) {
    distances.class_fraction[k] =
        static_cast<double>(sums[k].pixels) / static_cast<double>(labels.size());
    distances.class_mean_m[k] = mean_m(sums[k], depth.unit_m);
    all.readings += sums[k].readings;
    all.steps += sums[k].steps;
  }
  distances.mean_m = mean_m(all, depth.unit_m);
  return distances;
}

}  // namespace roomwise::segment
