#include "services/ekf_svc/core/map_pair_index.h"

#include <algorithm>
#include <tuple>

namespace roomwise::ekf {
namespace {

constexpr double kBin_m = 0.05;

std::uint32_t key_of(int bin, std::int8_t first, std::int8_t second) {
  return static_cast<std::uint32_t>(bin) << 16U |
         static_cast<std::uint32_t>(static_cast<std::uint8_t>(first)) << 8U |
         static_cast<std::uint8_t>(second);
}

}  // namespace

MapPairIndex::MapPairIndex(const MapSnapshot& map) {
  const std::size_t count = map.landmarks.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      if (i == j || map.landmarks[i].identity >= 0 || map.landmarks[j].identity >= 0) continue;
      const double distance_m = (map.positions_m[i] - map.positions_m[j]).norm();
      if (distance_m < kDistanceMin_m || distance_m > kDistanceMax_m) continue;
      pairs_.push_back({key_of(static_cast<int>(distance_m / kBin_m), map.landmarks[i].kind,
                               map.landmarks[j].kind),
                        static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.key, a.first, a.second) < std::tie(b.key, b.first, b.second);
  });
}

std::span<const MapPairIndex::Pair> MapPairIndex::find(double distance_m, std::int8_t first,
                                                       std::int8_t second, int shift) const {
  const int bin = std::max(0, static_cast<int>(distance_m / kBin_m) + shift);
  const std::uint32_t key = key_of(bin, first, second);
  const auto begin = std::lower_bound(pairs_.begin(), pairs_.end(), key,
                                      [](const Pair& pair, auto k) { return pair.key < k; });
  const auto end = std::upper_bound(begin, pairs_.end(), key,
                                    [](auto k, const Pair& pair) { return k < pair.key; });
  return {begin, end};
}

}  // namespace roomwise::ekf
