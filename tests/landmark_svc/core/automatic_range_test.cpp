#include "services/landmark_svc/core/automatic_range.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace roomwise::landmark {
namespace {

constexpr int kSide_px = 100;

/// The left `share` of the image at `near_mm`, the rest at `far_mm`.
DepthImage two_depths(double share, int near_mm, int far_mm) {
  DepthImage depth{kSide_px, kSide_px, 0.001, {}};
  for (int i = 0; i < kSide_px * kSide_px; ++i) {
    const bool is_near = i % kSide_px < share * kSide_px;
    depth.steps.push_back(static_cast<std::uint16_t>(is_near ? near_mm : far_mm));
  }
  return depth;
}

std::optional<double> range_m(const DepthImage& depth) {
  DisparityTable table;
  table.prepare(depth.unit_m, 351.0);
  return automatic_range_m(depth, table, {0, 0, depth.width_px, depth.height_px});
}

RC_GTEST_PROP(AutomaticRange, LiesInTheMiddleBetweenTwoDepthsHoweverMuchEachFills, ()) {
  const int near_mm = *rc::gen::inRange(600, 2000);
  const int far_mm = *rc::gen::inRange(2200, 4000);
  const double share = 0.01 * *rc::gen::inRange(10, 90);
  const auto found_m = range_m(two_depths(share, near_mm, far_mm));
  RC_ASSERT(found_m.has_value());
  RC_ASSERT(std::abs(*found_m - 0.0005 * (near_mm + far_mm)) < 0.051);
}

TEST(AutomaticRange, BadDataDoesNotCount) {
  DepthImage depth = two_depths(0.5, 1000, 3000);
  for (std::size_t i = 0; i < depth.steps.size(); i += 3) {
    depth.steps[i] = static_cast<std::uint16_t>(i % 2 == 0 ? 0 : 7000);
  }
  ASSERT_TRUE(range_m(depth).has_value());
  EXPECT_NEAR(*range_m(depth), 2.0, 0.06);
}

TEST(AutomaticRange, ThereIsNoneWithoutTwoGroups) {
  EXPECT_FALSE(range_m(two_depths(1.0, 2000, 2000)).has_value());
  EXPECT_FALSE(range_m(two_depths(1.0, 0, 0)).has_value());
}

}  // namespace
}  // namespace roomwise::landmark
