#include "services/segment_svc/core/free_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kStep_rad = std::numbers::pi / 180.0;
constexpr int kStride_px = 2;   // every second pixel each way says enough
constexpr int kBlockedMin = 2;  // pixels of a cell that block it: one alone may be noise
constexpr double kGap_m =
    0.15;  // floor may be missing this far, or three image rows if that is more

/// Bin of a direction given by its tangent, without an arc tangent per pixel.
class BinOfTangent {
 public:
  BinOfTangent() {
    for (int i = 0; i < kSize; ++i) {
      const double tangent = (i + 0.5) / kHalf - 1.0;
      bin_[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(
          std::lround(std::atan(tangent) / kStep_rad) + FreeRange::kBins / 2);
    }
  }
  /// -1 where the direction (x forward, y left) is beyond 45 degrees.
  int operator()(float x, float y) const {
    if (!(x > 0.0F) || std::abs(y) >= x) return -1;
    return bin_[static_cast<std::size_t>(static_cast<float>(kHalf) * (y / x + 1.0F))];
  }

 private:
  static constexpr int kHalf = 2048;
  static constexpr int kSize = 2 * kHalf;
  std::array<std::int8_t, kSize> bin_{};
};

}  // namespace

double FreeRange::first_bearing_rad() { return -(kBins / 2) * kStep_rad; }
double FreeRange::step_rad() { return kStep_rad; }

const std::array<BearingBin, FreeRange::kBins>& FreeRange::measure(
    const RgbdFrame& frame, const CameraView& view, const FloorFrame& frame_of_floor,
    const std::vector<std::uint8_t>& labels) {
  count(frame, view, frame_of_floor, labels);
  // Neighbouring image rows see the floor z^2 / (f h) apart.
  const double row_gap_per_m2 =
      kStride_px / (view.camera().fy_px * std::max(0.05, frame_of_floor.floor.height_m));
  for (std::size_t k = 0; k < kBins; ++k) {
    const Direction& direction = directions_[k];
    const double unknown = static_cast<double>(direction.unknown);
    bins_[k].unknown_ratio = direction.pixels > 0 ? unknown / direction.pixels : 1.0;
    bins_[k].free_range_m = free_range_m(direction, 3.0 * row_gap_per_m2);
  }
  return bins_;
}

void FreeRange::count(const RgbdFrame& frame, const CameraView& view,
                      const FloorFrame& frame_of_floor, const std::vector<std::uint8_t>& labels) {
  static const BinOfTangent bin_of;
  std::fill(directions_.begin(), directions_.end(), Direction{});
  const Eigen::Vector3f forward = frame_of_floor.forward.cast<float>();
  const Eigen::Vector3f left = frame_of_floor.left.cast<float>();
  const Eigen::Vector3f up = frame_of_floor.floor.normal.cast<float>();
  const auto forward_m = static_cast<float>(frame_of_floor.forward_m);
  const auto left_m = static_cast<float>(frame_of_floor.left_m);
  const auto up_m = static_cast<float>(frame_of_floor.floor.height_m);
  const auto unit_m = static_cast<float>(view.unit_m());
  const auto robot_height_m = static_cast<float>(params_.robot_height_m);
  const int width = view.width_px();
  for (int v = 0; v < view.height_px(); v += kStride_px) {
    const float ray_y = view.ray_y()[static_cast<std::size_t>(v)];
    for (int u = 0; u < width; u += kStride_px) {
      const auto pixel = static_cast<std::size_t>(v * width + u);
      const Eigen::Vector3f ray(view.ray_x()[static_cast<std::size_t>(u)], ray_y, 1.0F);
      const std::uint8_t label = labels[pixel];
      if (label == kUnknown) {
        const int bin = bin_of(forward.dot(ray), left.dot(ray));
        if (bin < 0) continue;
        ++directions_[static_cast<std::size_t>(bin)].pixels;
        ++directions_[static_cast<std::size_t>(bin)].unknown;
        continue;
      }
      const float z_m = unit_m * static_cast<float>(frame.depth.steps[pixel]);
      const float x_m = z_m * forward.dot(ray) + forward_m;
      const float y_m = z_m * left.dot(ray) + left_m;
      const int bin = bin_of(x_m, y_m);
      if (bin < 0) continue;
      Direction& direction = directions_[static_cast<std::size_t>(bin)];
      ++direction.pixels;
      const float height_m = z_m * up.dot(ray) + up_m;
      if (height_m > robot_height_m) continue;
      const auto cell =
          static_cast<int>(std::sqrt(x_m * x_m + y_m * y_m) / static_cast<float>(kCell_m));
      if (cell >= kCells) continue;
      auto& counts = label == kAccessible ? direction.floor : direction.blocked;
      ++counts[static_cast<std::size_t>(cell)];
    }
  }
}

double FreeRange::free_range_m(const Direction& direction, double gap_per_m2) const {
  double seen_to_m = 0.0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double start_m = static_cast<double>(cell) * kCell_m;
    if (direction.blocked[cell] >= kBlockedMin) return std::min(start_m, seen_to_m);
    if (seen_to_m > 0.0 && start_m - seen_to_m > std::max(kGap_m, gap_per_m2 * start_m * start_m))
      break;
    if (direction.floor[cell] > 0) seen_to_m = start_m + kCell_m;
  }
  return seen_to_m;
}

}  // namespace roomwise::segment
