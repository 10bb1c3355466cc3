#include "services/segment_svc/core/view_distances.h"

#include <cmath>
#include <numeric>

namespace roomwise::segment {
namespace {

constexpr double kCell_m = 0.01;
constexpr double kNearShare = 0.02;
constexpr int kStride_px = 2;

}  // namespace

ViewDistances DistanceMeter::measure(const RgbdFrame& frame, const CameraView& view,
                                     const FloorFrame& frame_of_floor,
                                     const std::vector<std::uint8_t>& labels) {
  ViewDistances distances;
  measure_classes(frame, view, labels, distances);
  measure_corridor(frame, view, frame_of_floor, labels, distances);
  return distances;
}

void DistanceMeter::measure_classes(const RgbdFrame& frame, const CameraView& view,
                                    const std::vector<std::uint8_t>& labels,
                                    ViewDistances& distances) const {
  std::array<std::uint32_t, 256> pixels{};
  std::array<std::uint32_t, 256> readings{};
  std::array<std::uint64_t, 256> steps{};
  const auto range_max_steps = static_cast<std::uint64_t>(params_.range_max_m / view.unit_m());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::uint16_t step = frame.depth.steps[i];
    const bool is_reading = step > 0 && step <= range_max_steps;
    ++pixels[labels[i]];
    readings[labels[i]] += is_reading ? 1U : 0U;
    steps[labels[i]] += is_reading ? step : 0U;
  }
  const auto mean_m = [&](std::uint64_t sum, std::uint64_t count) {
    return count == 0 ? 0.0 : view.unit_m() * static_cast<double>(sum) / static_cast<double>(count);
  };
  for (std::size_t k = 0; k < kLabels.size(); ++k) {
    distances.class_fraction[k] =
        static_cast<double>(pixels[kLabels[k]]) / static_cast<double>(labels.size());
    distances.class_mean_m[k] = mean_m(steps[kLabels[k]], readings[kLabels[k]]);
  }
  distances.mean_m = mean_m(std::accumulate(steps.begin(), steps.end(), std::uint64_t{0}),
                            std::accumulate(readings.begin(), readings.end(), std::uint64_t{0}));
}

void DistanceMeter::measure_corridor(const RgbdFrame& frame, const CameraView& view,
                                     const FloorFrame& frame_of_floor,
                                     const std::vector<std::uint8_t>& labels,
                                     ViewDistances& distances) {
  in_corridor_.fill(0);
  const auto half_width_m =
      static_cast<float>(0.5 * params_.robot_width_m + params_.corridor_margin_m);
  const auto length_m = static_cast<float>(params_.corridor_length_m);
  const auto robot_height_m = static_cast<float>(params_.robot_height_m);
  const Eigen::Vector3f forward = frame_of_floor.forward.cast<float>();
  const Eigen::Vector3f left = frame_of_floor.left.cast<float>();
  const Eigen::Vector3f up = frame_of_floor.floor.normal.cast<float>();
  const auto forward_m = static_cast<float>(frame_of_floor.forward_m);
  const auto left_m = static_cast<float>(frame_of_floor.left_m);
  const auto up_m = static_cast<float>(frame_of_floor.floor.height_m);
  int unknown = 0;
  int known = 0;
  for (int v = 0; v < view.height_px(); v += kStride_px) {
    for (int u = 0; u < view.width_px(); u += kStride_px) {
      const auto pixel = static_cast<std::size_t>(v * view.width_px() + u);
      const Eigen::Vector3f ray(view.ray_x()[static_cast<std::size_t>(u)],
                                view.ray_y()[static_cast<std::size_t>(v)], 1.0F);
      const bool is_unknown = labels[pixel] == kUnknown;
      // An unknown pixel is put where its ray meets the floor.
      const float descent = -up.dot(ray);
      if (is_unknown && !(descent > 1e-3F)) continue;
      const float z_m = is_unknown ? up_m / descent
                                   : static_cast<float>(view.unit_m()) *
                                         static_cast<float>(frame.depth.steps[pixel]);
      const float x_m = z_m * forward.dot(ray) + forward_m;
      const float y_m = z_m * left.dot(ray) + left_m;
      if (std::abs(y_m) > half_width_m || !(x_m > 0.0F)) continue;
      if (x_m <= length_m) ++(is_unknown ? unknown : known);
      if (is_unknown || labels[pixel] == kAccessible || z_m * up.dot(ray) + up_m > robot_height_m)
        continue;
      const auto cell = static_cast<std::size_t>(x_m / static_cast<float>(kCell_m));
      if (cell < kCells) ++in_corridor_[cell];
    }
  }
  const int looked = unknown + known;
  distances.corridor_unknown_ratio = looked > 0 ? static_cast<double>(unknown) / looked : 1.0;
  distances.near_m = near_quantile_m();
}

double DistanceMeter::near_quantile_m() const {
  const int total = std::accumulate(in_corridor_.begin(), in_corridor_.end(), 0);
  if (total == 0) return 0.0;
  int nearer = 0;
  std::size_t cell = 0;
  while ((nearer += in_corridor_[cell]) <= kNearShare * total) ++cell;
  return (static_cast<double>(cell) + 0.5) * kCell_m;
}

}  // namespace roomwise::segment
