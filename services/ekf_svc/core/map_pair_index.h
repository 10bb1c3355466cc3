#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "services/ekf_svc/core/map_snapshot.h"

namespace roomwise::ekf {

/// All pairs of a map's landmarks 0.5 to 6 m apart, to be found by what does not depend on where
/// one looks from: their distance, in bins of 5 cm, and the kinds of both.
class MapPairIndex {
 public:
  explicit MapPairIndex(const MapSnapshot& map);

  struct Pair {
    std::uint32_t key;
    std::uint32_t first;
    std::uint32_t second;
  };
  /// Pairs of landmarks of these kinds, in this order, in the bin of `distance_m` shifted by
  /// `shift` bins.
  std::span<const Pair> find(double distance_m, std::int8_t first, std::int8_t second,
                             int shift) const;

  static constexpr double kDistanceMin_m = 0.5;
  static constexpr double kDistanceMax_m = 6.0;

 private:
  std::vector<Pair> pairs_;  // in order of key
};

}  // namespace roomwise::ekf
