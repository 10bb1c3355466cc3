#include "services/create_driver/core/body_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roomwise::create {
namespace {

using Outcome = BodyReadings::Outcome;
using std::chrono::milliseconds;
using ::testing::ElementsAre;

constexpr Duration kStart = std::chrono::hours(1);

StreamFrame frame_after(const Bytes& gap) {
  StreamFrame frame;
  std::copy(gap.begin(), gap.end(), frame.gap_bytes.begin());
  frame.gap_size = gap.size();
  return frame;
}

TEST(BodyReadings, AreAskedForEvery150Milliseconds) {
  BodyReadings readings;
  Bytes sent;
  readings.ask_if_due(kStart, sent);
  EXPECT_THAT(sent, ElementsAre(142, 2));
  SensorPackets packets;
  ASSERT_EQ(readings.look(kStart + milliseconds(15), frame_after({0, 0, 0, 0, 0, 0}), packets),
            Outcome::kReading);
  readings.ask_if_due(kStart + milliseconds(149), sent);
  EXPECT_EQ(sent.size(), 2U);
  readings.ask_if_due(kStart + milliseconds(150), sent);
  EXPECT_EQ(sent.size(), 4U);
}

TEST(BodyReadings, TheAnswerStandsBetweenTwoFrames) {
  BodyReadings readings;
  Bytes sent;
  readings.ask_if_due(kStart, sent);
  SensorPackets packets;
  EXPECT_EQ(readings.look(kStart, frame_after({}), packets), Outcome::kNothing);
  // infrared 255, buttons 5, distance -7 mm, angle 19 degrees
  const StreamFrame frame = frame_after({255, 5, 0xFF, 0xF9, 0, 19});
  ASSERT_EQ(readings.look(kStart + milliseconds(15), frame, packets), Outcome::kReading);
  EXPECT_EQ(packets[Packet::kDistance_mm], -7);
  EXPECT_EQ(packets[Packet::kAngle_deg], 19);
  EXPECT_EQ(packets[Packet::kButtons], 5);
  EXPECT_EQ(readings.look(kStart + milliseconds(30), frame, packets), Outcome::kNothing);
}

TEST(BodyReadings, NoiseBetweenFramesIsNoAnswerAndPatienceEnds) {
  BodyReadings readings;
  Bytes sent;
  readings.ask_if_due(kStart, sent);
  SensorPackets packets;
  const StreamFrame noisy = frame_after({1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(readings.look(kStart + milliseconds(50), noisy, packets), Outcome::kNothing);
  EXPECT_EQ(readings.look(kStart + milliseconds(100), noisy, packets), Outcome::kLost);
  EXPECT_EQ(readings.look(kStart + milliseconds(115), noisy, packets), Outcome::kNothing);
}

TEST(BodyReadings, SixBytesNobodyAskedForAreNoReading) {
  BodyReadings readings;
  SensorPackets packets;
  EXPECT_EQ(readings.look(kStart, frame_after({0, 0, 0, 9, 0, 9}), packets), Outcome::kNothing);
}

}  // namespace
}  // namespace roomwise::create
