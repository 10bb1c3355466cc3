#include "services/segment_svc/core/view_distances.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace roomwise::segment {
namespace {

RC_GTEST_PROP(ViewDistances, EqualPlainSums, ()) {
  DepthImage depth;
  depth.width_px = *rc::gen::inRange(1, 40);
  depth.height_px = *rc::gen::inRange(1, 9);
  const auto pixels = static_cast<std::size_t>(depth.width_px * depth.height_px);
  depth.steps = *rc::gen::container<std::vector<std::uint16_t>>(
      pixels, rc::gen::inRange<std::uint16_t>(0, 7000));
  std::vector<std::uint8_t> labels;
  for (std::size_t i = 0; i < pixels; ++i) {
    labels.push_back(kLabels[*rc::gen::inRange<std::size_t>(0, kLabels.size())]);
  }
  const ViewDistances distances = measure_distances(depth, 6.0, labels);

  double all_m = 0.0;
  int all = 0;
  for (std::size_t k = 0; k < kLabels.size(); ++k) {
    double sum_m = 0.0;
    int readings = 0;
    int of_class = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      if (labels[i] != kLabels[k]) continue;
      ++of_class;
      if (depth.steps[i] == 0 || depth.steps[i] > 6000) continue;
      ++readings;
      sum_m += 0.001 * depth.steps[i];
    }
    all_m += sum_m;
    all += readings;
    RC_ASSERT(std::abs(distances.class_fraction[k] * static_cast<double>(pixels) - of_class) <
              1e-6);
    RC_ASSERT(std::abs(distances.class_mean_m[k] - (readings > 0 ? sum_m / readings : 0.0)) < 1e-9);
  }
  RC_ASSERT(std::abs(distances.mean_m - (all > 0 ? all_m / all : 0.0)) < 1e-9);
}

}  // namespace
}  // namespace roomwise::segment
