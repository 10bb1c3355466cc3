#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace roomwise {

struct TimeMatch {
  std::size_t first;   ///< index into the first list
  std::size_t second;  ///< and into the second
};

/// Pairs two lists of times [us], each in ascending order, one to one: the closest pair first, then
/// the closest of what is left, as long as they are no more than `tolerance_us` apart. In the order
/// of the first list. (As associate.py of the TUM RGB-D benchmark, Sturm et al. 2012.)
std::vector<TimeMatch> associate_by_time(std::span<const std::int64_t> first,
                                         std::span<const std::int64_t> second,
                                         std::int64_t tolerance_us);

}  // namespace roomwise
