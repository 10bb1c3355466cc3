#include "services/segment_svc/core/color/color_table.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/segment_svc/support/taught.h"

namespace roomwise::segment {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

Label label_of(const ColorTable& table, const Rgb& rgb) { return table.classify(rgb.data()); }

TEST(ColorTable, NamesTheLikeliestClassAndLeavesStrangeColoursUnknown) {
  const ColorTable table({around(60, 60, 160), around(200, 200, 190), around(150, 110, 70)});
  EXPECT_EQ(label_of(table, {62, 58, 158}), kObstacle);
  EXPECT_EQ(label_of(table, {205, 198, 188}), kWall);
  EXPECT_EQ(label_of(table, {148, 112, 72}), kAccessible);
  EXPECT_EQ(label_of(table, {10, 250, 10}), kUnknown);
}

TEST(ColorTable, ColorsTaughtBrightAreUnknownInTheDark) {
  const ColorTable table({around(60, 60, 160), around(200, 200, 190), around(150, 110, 70)});
  EXPECT_EQ(label_of(table, {3, 3, 8}), kUnknown);
  EXPECT_EQ(label_of(table, {10, 10, 9}), kUnknown);
}

}  // namespace
}  // namespace roomwise::segment
