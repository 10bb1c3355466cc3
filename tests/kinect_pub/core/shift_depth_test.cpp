#include "services/kinect_pub/core/shift_depth.h"

#include <gtest/gtest.h>

#include <vector>

namespace roomwise::kinect {
namespace {

TEST(ShiftDepth, ReferencePlaneLiesAtItsDistance) {
  // 3/8 of a pixel beside shift 0: word 4 * (200 + 0.375) = 801.5.
  const ShiftTable table = shift_table({});
  EXPECT_LT(table[801], 1200);
  EXPECT_GE(table[802], 1200);
}

TEST(ShiftDepth, DepthGrowsWithTheWordUntilThereIsNone) {
  const ShiftTable table = shift_table({});
  std::size_t word = 1;
  while (table[word] >= table[word - 1]) ++word;
  EXPECT_GT(table[word - 1], 9000);
  for (; word < table.size(); ++word) ASSERT_EQ(table[word], 0) << word;
}

TEST(ShiftDepth, OneWordIsAKinectsDisparityStep) {
  // 1/depth falls by the same amount with every word: a quarter pixel against the baseline.
  const ShiftTable table = shift_table({});
  const double step_per_mm = 0.1042 / (4.0 * 7.5 * 1200.0);
  for (std::size_t word = 400; word < 1000; word += 100) {
    const double ten_steps = 1.0 / table[word] - 1.0 / table[word + 10];
    const double rounding = 2.0 / (1.0 * table[word] * table[word]);  // depths are whole mm
    EXPECT_NEAR(ten_steps, 10.0 * step_per_mm, rounding);
  }
}

TEST(ShiftDepth, NoReadingStaysNone) {
  std::vector<std::uint16_t> words = {kNoShift, 800, 0xF800 | 800, 0xFFFF};
  const ShiftTable table = shift_table({});
  shifts_to_depths(table, words);
  EXPECT_EQ(words, (std::vector<std::uint16_t>{0, table[800], table[800], 0}));
}

TEST(ShiftDepth, NonsenseGeometryGivesNoDepthsRatherThanWrongOnes) {
  for (const ZeroPlane& plane :
       {ZeroPlane{0.0, 0.0, 0.0, 0.0}, ZeroPlane{1e300, 1e300, -1e300, 0.0},
        ZeroPlane{120.0, 0.1042, 0.0, 200.0}}) {
    for (const std::uint16_t depth : shift_table(plane)) ASSERT_LE(depth, kShiftMax_mm);
  }
}

}  // namespace
}  // namespace roomwise::kinect
