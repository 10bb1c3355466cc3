#include "services/segment_svc/core/free_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/multiversion.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kStep_rad = std::numbers::pi / 180.0;
constexpr int kBlockedMin = 2;   // pixels of a cell that block it: one alone may be noise
constexpr double kGap_m = 0.15;  // floor may be missing this far, or three rows if that is more

constexpr int kHalf = 2048;  // slots of the table of bearings for tangents from 0 to 1

/// Bins of the directions whose tangents lie in [-1, 1), without an arc tangent per pixel.
std::array<std::uint8_t, 2 * kHalf> make_bins() {
  std::array<std::uint8_t, 2 * kHalf> bins{};
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double tangent = (static_cast<double>(i) + 0.5) / kHalf - 1.0;
    bins[i] = static_cast<std::uint8_t>(std::lround(std::atan(tangent) / kStep_rad) +
                                        FreeRange::kBins / 2);
  }
  return bins;
}

/// Cells a metre forward is worth in each bin.
std::array<float, FreeRange::kBins> make_cells_per_m() {
  std::array<float, FreeRange::kBins> cells_per_m{};
  for (std::size_t k = 0; k < cells_per_m.size(); ++k) {
    const double bearing_rad = FreeRange::first_bearing_rad() + static_cast<double>(k) * kStep_rad;
    cells_per_m[k] = static_cast<float>(1.0 / (kCell_m * std::cos(bearing_rad)));
  }
  return cells_per_m;
}

/// Slot of each pixel's tangent in the table of bearings; -1 beyond 45 degrees.
ROOMWISE_MULTIVERSION
void to_tangents(const float* x_m, const float* y_m, std::size_t count, std::int16_t* tangent) {
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_seen = std::abs(y_m[i]) < x_m[i];
    const float x = is_seen ? x_m[i] : 1.0F;
    const float y = is_seen ? y_m[i] : 0.0F;
    const int slot = static_cast<int>(static_cast<float>(kHalf) * (y / x + 1.0F));
    const int inside = slot < 2 * kHalf ? slot : 2 * kHalf - 1;
    tangent[i] = static_cast<std::int16_t>(is_seen ? inside : -1);
  }
}

}  // namespace

double FreeRange::first_bearing_rad() {
  constexpr int kMiddle = kBins / 2;
  return -kMiddle * kStep_rad;
}
double FreeRange::step_rad() { return kStep_rad; }

void FreeRange::begin() { std::fill(directions_.begin(), directions_.end(), Direction{}); }

void FreeRange::add(const GroundRow& row) {
  static const auto bin_of_tangent = make_bins();
  static const auto cells_per_m = make_cells_per_m();
  const std::size_t count = row.x_m.size();
  tangent_.resize(count);
  to_tangents(row.x_m.data(), row.y_m.data(), count, tangent_.data());
  const auto robot_height_m = static_cast<float>(robot_height_m_);
  for (std::size_t i = 0; i < count; ++i) {
    if (tangent_[i] < 0) continue;
    const std::size_t bin = bin_of_tangent[static_cast<std::size_t>(tangent_[i])];
    Direction& direction = directions_[bin];
    const std::uint8_t label = row.label[i];
    ++direction.pixels;
    direction.unknown_pixels += label == kUnknown ? 1 : 0;
    const float cell = row.x_m[i] * cells_per_m[bin];
    if (!(cell < static_cast<float>(kCells)) || row.height_m[i] > robot_height_m) continue;
    auto& counts = label == kAccessible ? direction.floor
                   : label == kUnknown  ? direction.unknown
                                        : direction.blocked;
    ++counts[static_cast<std::size_t>(cell)];
  }
}

void FreeRange::end(double row_gap_per_m2, std::array<BearingBin, kBins>& bins) const {
  for (std::size_t k = 0; k < kBins; ++k) {
    const Direction& direction = directions_[k];
    bins[k].unknown_ratio = direction.pixels > 0
                                ? static_cast<double>(direction.unknown_pixels) / direction.pixels
                                : 1.0;
    bins[k].free_range_m = free_range_m(direction, 3.0 * row_gap_per_m2);
    bins[k].obstacle_range_m = obstacle_range_m(direction);
  }
}

double FreeRange::free_range_m(const Direction& direction, double gap_per_m2) const {
  double seen_to_m = -1.0;  // not in view yet
  double free_m = 0.0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double start_m = static_cast<double>(cell) * kCell_m;
    if (direction.blocked[cell] >= kBlockedMin) return std::min(start_m, free_m);
    if (seen_to_m >= 0.0 && start_m - seen_to_m > std::max(kGap_m, gap_per_m2 * start_m * start_m))
      return free_m;
    if (direction.floor[cell] > direction.unknown[cell]) {
      seen_to_m = free_m = start_m + kCell_m;
    } else if (seen_to_m < 0.0 && direction.unknown[cell] > 0) {
      seen_to_m = start_m;
    }
  }
  return free_m;
}

double FreeRange::obstacle_range_m(const Direction& direction) {
  const auto first = std::find_if(direction.blocked.begin(), direction.blocked.end(),
                                  [](std::uint16_t pixels) { return pixels >= kBlockedMin; });
  if (first == direction.blocked.end()) return 0.0;
  return (static_cast<double>(first - direction.blocked.begin()) + 0.5) * kCell_m;
}

}  // namespace roomwise::segment
