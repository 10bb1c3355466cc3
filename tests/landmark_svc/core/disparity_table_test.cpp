#include "services/landmark_svc/core/disparity_table.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace roomwise::landmark {
namespace {

DisparityTable millimetre_table() {
  DisparityTable table;
  table.prepare(0.001, 351.0);
  return table;
}

TEST(DisparityTable, ZeroMinusOneAndBeyond4095AreBad) {
  const DisparityTable table = millimetre_table();
  for (const int bad : {0, 59, 4096, 5000, 65534, 65535}) {
    EXPECT_FALSE(table.is_good(static_cast<std::uint16_t>(bad))) << bad;
  }
  for (const int good : {60, 1220, 3810, 4095}) {
    EXPECT_TRUE(table.is_good(static_cast<std::uint16_t>(good))) << good;
  }
}

TEST(DisparityTable, GoodStepsAreOneRange) {
  for (const double unit_m : {0.001, 0.0001, 0.0002, 0.1, 1e-9, 5.0, 1e300}) {
    DisparityTable table;
    table.prepare(unit_m, 351.0);
    for (int step = 0; step < 65536; ++step) {
      const bool in_range = step >= table.smallest_good_step() && step <= table.largest_good_step();
      ASSERT_EQ(table.is_good(static_cast<std::uint16_t>(step)), in_range) << unit_m << " " << step;
    }
  }
}

RC_GTEST_PROP(DisparityTable, NearerMeansMoreDisparity, ()) {
  const DisparityTable table = millimetre_table();
  const auto a = *rc::gen::inRange<std::uint16_t>(60, 4096);
  const auto b = *rc::gen::inRange<std::uint16_t>(60, 4096);
  if (a < b) RC_ASSERT(table.parts(a) >= table.parts(b));
}

RC_GTEST_PROP(DisparityTable, RoundsToAnEighthOfAQuantum, ()) {
  const DisparityTable table = millimetre_table();
  const auto step = *rc::gen::inRange<std::uint16_t>(60, 4096);
  const double quanta = table.parts(step) / double{DisparityTable::kPartsPerQuantum};
  RC_ASSERT(std::abs(quanta - 351.0 / (step * 0.001)) <= 1.0 / 16.0 + 1e-9);
  RC_ASSERT(std::abs(table.depth_from_quanta_m(351.0 / (step * 0.001)) - step * 0.001) < 1e-9);
}

TEST(DisparityTable, QuantumIsThatOfARealKinect) {
  const DisparityTable table = millimetre_table();
  EXPECT_NEAR(table.quantum_m(1.0), 0.0029, 1e-4);
  EXPECT_NEAR(table.quantum_m(2.0), 0.0115, 2e-4);
  EXPECT_NEAR(table.quantum_m(3.8), 0.0418, 1e-3);
}

}  // namespace
}  // namespace roomwise::landmark
