#include "services/create_driver/core/mode_reading.h"

#include <gtest/gtest.h>

namespace roomwise::create {
namespace {

TEST(ModeReading, IsTheManualsUntilItLearnsOtherwise) {
  const ModeReading reading;
  EXPECT_EQ(reading.mode(0), OiMode::kOff);
  EXPECT_EQ(reading.mode(1), OiMode::kPassive);
  EXPECT_EQ(reading.mode(2), OiMode::kSafe);
  EXPECT_EQ(reading.mode(3), OiMode::kFull);
}

TEST(ModeReading, ARobotThatSaysTwoInPassiveCountsFromOne) {
  ModeReading reading;
  ASSERT_TRUE(reading.learn_in_passive(2));
  EXPECT_TRUE(reading.is_offset());
  EXPECT_EQ(reading.mode(1), OiMode::kOff);
  EXPECT_EQ(reading.mode(2), OiMode::kPassive);
  EXPECT_EQ(reading.mode(3), OiMode::kSafe);
  EXPECT_EQ(reading.mode(4), OiMode::kFull);
  ASSERT_TRUE(reading.learn_in_passive(1));
  EXPECT_EQ(reading.mode(2), OiMode::kSafe);
}

TEST(ModeReading, NumbersNoManualListsAreUnknown) {
  ModeReading reading;
  for (const int byte : {4, 5, 32, 255, -1})
    EXPECT_EQ(reading.mode(byte), OiMode::kUnknown) << byte;
  for (const int byte : {0, 3, 32}) EXPECT_FALSE(reading.learn_in_passive(byte)) << byte;
  ASSERT_TRUE(reading.learn_in_passive(2));
  EXPECT_EQ(reading.mode(32), OiMode::kUnknown);
}

}  // namespace
}  // namespace roomwise::create
