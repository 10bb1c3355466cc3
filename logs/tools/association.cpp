#include "logs/tools/association.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace roomwise {

std::vector<TimeMatch> associate_by_time(std::span<const std::int64_t> first,
                                         std::span<const std::int64_t> second,
                                         std::int64_t tolerance_us) {
  std::vector<TimeMatch> candidates;
  std::size_t window = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (window < second.size() && second[window] < first[i] - tolerance_us) ++window;
    for (std::size_t k = window; k < second.size() && second[k] <= first[i] + tolerance_us; ++k) {
      candidates.push_back({i, k});
    }
  }
  std::ranges::sort(candidates, {}, [&](const TimeMatch& match) {
    return std::tuple(std::abs(first[match.first] - second[match.second]), match.first,
                      match.second);
  });
  std::vector<bool> first_taken(first.size());
  std::vector<bool> second_taken(second.size());
  std::erase_if(candidates, [&](const TimeMatch& match) {
    if (first_taken[match.first] || second_taken[match.second]) return true;
    first_taken[match.first] = true;
    second_taken[match.second] = true;
    return false;
  });
  std::ranges::sort(candidates, {}, &TimeMatch::first);
  return candidates;
}

}  // namespace roomwise
