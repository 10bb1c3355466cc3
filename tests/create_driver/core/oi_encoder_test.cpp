#include "services/create_driver/core/oi_encoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace roomwise::create {
namespace {

using ::testing::ElementsAre;

Bytes drive(double left_mps, double right_mps) {
  Bytes bytes;
  append_drive({left_mps, right_mps}, bytes);
  return bytes;
}

TEST(OiEncoder, TheRightWheelComesFirstHighByteFirst) {
  EXPECT_THAT(drive(0.2, -0.2), ElementsAre(145, 255, 56, 0, 200));  // -200 is 255 56
  EXPECT_THAT(drive(-0.001, 0.5), ElementsAre(145, 1, 244, 255, 255));
}

TEST(OiEncoder, SpeedsBeyondTheRobotsAreCutAndNonsenseIsZero) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(drive(9.0, -1e300), ElementsAre(145, 254, 12, 1, 244));
  EXPECT_THAT(drive(kNan, kInf), ElementsAre(145, 0, 0, 0, 0));
}

TEST(OiEncoder, AsksForTheManualsStream) {
  Bytes bytes;
  append_stream_request(Bytes{29, 13}, bytes);
  EXPECT_THAT(bytes, ElementsAre(148, 2, 29, 13));
}

TEST(OiEncoder, CommandsWithoutDataAreOneByte) {
  Bytes bytes;
  append_command(Opcode::kStart, bytes);
  append_command(Opcode::kSafe, bytes);
  append_command(Opcode::kFull, bytes);
  append_command(Opcode::kReset, bytes);
  append_query(2, bytes);
  EXPECT_THAT(bytes, ElementsAre(128, 131, 132, 7, 142, 2));
}

TEST(OiEncoder, StoppingCompletesWhateverWasCutShortAndEndsInStart) {
  const std::size_t zeros = kStopAndRest.size() - 6;
  EXPECT_GE(zeros, 7U);  // a stream request for four packets lacks at most five bytes, a drive four
  for (std::size_t i = 0; i < zeros; ++i) EXPECT_EQ(kStopAndRest[i], 0);
  EXPECT_THAT(Bytes(kStopAndRest.begin() + static_cast<std::ptrdiff_t>(zeros), kStopAndRest.end()),
              ElementsAre(145, 0, 0, 0, 0, 128));
}

}  // namespace
}  // namespace roomwise::create
