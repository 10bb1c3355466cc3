#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace roomwise::landmark {

/// Readings of one column that are of one upright thing.
struct ScanCluster {
  float quanta = 0.0F;  ///< mean
  int rows = 0;
  int v_top_px = 0;
  int v_bottom_px = 0;
};

/// Sorts the readings of every column of an image into clusters while its rows go by, eight columns
/// at once. A reading belongs to the first cluster whose mean is within 2 quanta and 3 % of it, or
/// begins one. A column keeps three: the farthest gives way to what is nearer.
class ScanClusters {
 public:
  static constexpr std::size_t kAtOnce = 8;
  /// Up to a whole number of kAtOnce.
  static constexpr std::size_t padded(std::size_t columns) {
    return (columns + kAtOnce - 1) / kAtOnce * kAtOnce;
  }

  /// Makes room for so many columns: clear() allocates nothing then.
  void reserve(std::size_t columns);
  /// So many columns, and no reading.
  void clear(std::size_t columns);
  /// Row `v_px`, below all before. `quanta`: a reading for each column, 0 for none, and zeros up to
  /// padded().
  void add_row(int v_px, const float* quanta);
  /// The nearest cluster of a column, of those with at least `rows_min` rows.
  std::optional<ScanCluster> nearest(std::size_t column, double rows_min) const;

  static constexpr std::size_t kClusters = 3;
  /// The first, second or third cluster of kAtOnce columns; empty where rows is 0.
  struct alignas(kAtOnce * sizeof(float)) Tier {
    float sum[kAtOnce];  ///< of the readings [quanta]
    float rows[kAtOnce];
    float v_top_px[kAtOnce];
    float v_bottom_px[kAtOnce];
  };
  using Tiers = std::array<Tier, kClusters>;

 private:
  std::vector<Tiers> columns_;  // kAtOnce in each
};

}  // namespace roomwise::landmark
