#include "services/landmark_svc/core/automatic_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace roomwise::landmark {
namespace {

constexpr double kBin_m = 0.05;
constexpr std::size_t kBins = 82;  // up to 4.1 m
using Histogram = std::array<std::int64_t, kBins>;

double middle_m(std::size_t bin) { return (static_cast<double>(bin) + 0.5) * kBin_m; }

Histogram histogram_of(const DepthImage& depth, const DisparityTable& table,
                       const PixelRectangle& region) {
  constexpr int kStride_px = 4;
  Histogram histogram{};
  for (int v = region.v_begin_px; v < region.v_end_px; v += kStride_px) {
    for (int u = region.u_begin_px; u < region.u_end_px; u += kStride_px) {
      const std::uint16_t step = depth.at(u, v);
      if (!table.is_good(step)) continue;
      const auto bin = static_cast<std::size_t>(table.depth_m(step) / kBin_m);
      ++histogram[std::min(bin, kBins - 1)];
    }
  }
  return histogram;
}

struct Group {
  double count = 0.0;
  double sum_m = 0.0;
  double mean_m() const { return sum_m / count; }
};

/// Of the bins whose middle `belongs`.
template <class Belongs>
Group group_of(const Histogram& histogram, Belongs belongs) {
  Group group;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (!belongs(middle_m(bin))) continue;
    const auto count = static_cast<double>(histogram[bin]);
    group.count += count;
    group.sum_m += count * middle_m(bin);
  }
  return group;
}

}  // namespace

std::optional<double> automatic_range_m(const DepthImage& depth, const DisparityTable& table,
                                        const PixelRectangle& region) {
  constexpr double kFewest = 100.0;
  constexpr int kRounds = 50;
  const Histogram histogram = histogram_of(depth, table, region);
  const Group all = group_of(histogram, [](double) { return true; });
  if (all.count < kFewest) return std::nullopt;
  double threshold_m = all.mean_m();
  for (int round = 0; round < kRounds; ++round) {
    const Group near = group_of(histogram, [&](double z_m) { return z_m < threshold_m; });
    const Group far = group_of(histogram, [&](double z_m) { return z_m >= threshold_m; });
    if (near.count == 0.0 || far.count == 0.0) return std::nullopt;
    const double next_m = 0.5 * (near.mean_m() + far.mean_m());
    if (std::abs(next_m - threshold_m) < 1e-6) break;
    threshold_m = next_m;
  }
  return threshold_m;
}

}  // namespace roomwise::landmark
