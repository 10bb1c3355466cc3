#include "logs/tools/association.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace roomwise {
namespace {

std::vector<std::int64_t> some_times() {
  auto times =
      *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(0, 2'000'000));
  std::ranges::sort(times);
  return times;
}

RC_GTEST_PROP(Association, IsOneToOneAndWithinTheTolerance, ()) {
  const auto first = some_times();
  const auto second = some_times();
  std::set<std::size_t> seen_first;
  std::set<std::size_t> seen_second;
  for (const TimeMatch& match : associate_by_time(first, second, 20'000)) {
    RC_ASSERT(std::abs(first[match.first] - second[match.second]) <= 20'000);
    RC_ASSERT(seen_first.insert(match.first).second);
    RC_ASSERT(seen_second.insert(match.second).second);
  }
}

RC_GTEST_PROP(Association, LeavesNoPairThatWouldFit, ()) {
  const auto first = some_times();
  const auto second = some_times();
  std::set<std::size_t> seen_first;
  std::set<std::size_t> seen_second;
  for (const TimeMatch& match : associate_by_time(first, second, 20'000)) {
    seen_first.insert(match.first);
    seen_second.insert(match.second);
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t k = 0; k < second.size(); ++k) {
      if (seen_first.contains(i) || seen_second.contains(k)) continue;
      RC_ASSERT(std::abs(first[i] - second[k]) > 20'000);
    }
  }
}

TEST(Association, TheClosestPairComesFirst) {
  const std::vector<std::int64_t> first{0, 15'000};
  const std::vector<std::int64_t> second{12'000};
  const auto matches = associate_by_time(first, second, 20'000);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].first, 1U);
}

}  // namespace
}  // namespace roomwise
