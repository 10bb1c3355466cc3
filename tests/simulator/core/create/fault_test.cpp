// Every fault, as its host sees it in the bytes.
#include "services/simulator/core/create/fault.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "services/simulator/core/create/simulated_create.h"
#include "tests/simulator/core/create/oi_host.h"

namespace roomwise::simulator {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// What a stream of group 100 brought, cut at good frames as any receiver would.
struct Received {
  std::vector<Bytes> frames;  ///< 80 bytes of data each
  Bytes skipped;              ///< in no good frame

  int byte(std::size_t frame, std::size_t packet_offset) const {
    return frames.at(frame).at(packet_offset);
  }
};

// Places in group 100.
constexpr std::size_t kBumps = 0;
constexpr std::size_t kCliffLeft = 2;
constexpr std::size_t kTemperature = 21;
constexpr std::size_t kCharge = 22;
constexpr std::size_t kChargingSource = 39;
constexpr std::size_t kMode = 40;
constexpr std::size_t kEncoderLeft = 52;
constexpr std::size_t kLightLeft = 57;

Received cut(const Bytes& bytes) {
  Received received;
  for (std::size_t i = 0; i < bytes.size();) {
    const bool whole = i + 84 <= bytes.size() && bytes[i] == 19 && bytes[i + 1] == 81 &&
                       sums_to_zero({bytes.begin() + static_cast<std::ptrdiff_t>(i),
                                     bytes.begin() + static_cast<std::ptrdiff_t>(i + 84)});
    if (!whole) {
      received.skipped.push_back(bytes[i++]);
      continue;
    }
    const auto data = bytes.begin() + static_cast<std::ptrdiff_t>(i);
    received.frames.emplace_back(data + 3, data + 83);
    i += 84;
  }
  return received;
}

/// Streams group 100 in Safe at 100 mm/s from 0.02 s on, with one fault at 0.5 s, until 1.5 s.
class FaultTest : public ::testing::Test {
 protected:
  void run(const std::string& fault, Bytes drive = {145, 0, 100, 0, 100}) {
    SimulatedCreate::Setup setup;
    setup.faults = {parse_fault(fault)};
    create.emplace(setup);
    create->receive(Bytes{128, 131, 148, 1, 100});
    create->receive(drive);
    while (create->now() < Duration(500'000)) create->step({}, before_bytes);
    while (create->now() < Duration(1'500'000)) create->step({}, after_bytes);
    before = cut(before_bytes);
    after = cut(after_bytes);
    // A frame may have been under way at the cut.
    EXPECT_LT(before.skipped.size(), 84U);
  }
  std::vector<int> modes() const {
    std::vector<int> seen;
    for (std::size_t i = 0; i < after.frames.size(); ++i) seen.push_back(after.byte(i, kMode));
    return seen;
  }
  /// Ticks of the left wheel from frame to frame.
  std::vector<int> deltas() const {
    std::vector<int> seen;
    for (std::size_t i = 1; i < after.frames.size(); ++i) {
      seen.push_back(static_cast<std::int16_t>(word_at(after.frames[i], kEncoderLeft) -
                                               word_at(after.frames[i - 1], kEncoderLeft)));
    }
    return seen;
  }
  /// Frames of the 66 or so in a second that did not come whole.
  double frames_missing() const { return 66.0 - static_cast<double>(after.frames.size()); }

  std::optional<SimulatedCreate> create;
  Bytes before_bytes;
  Bytes after_bytes;
  Received before;
  Received after;
};

TEST_F(FaultTest, NoneLosesNoFrame) {
  run("at_s=9,kind=byte_loss");
  EXPECT_NEAR(frames_missing(), 0.0, 1.0);
  EXPECT_THAT(modes(), ::testing::Each(2));
  EXPECT_THAT(deltas(), ::testing::Each(::testing::AllOf(::testing::Ge(3), ::testing::Le(4))));
}

TEST_F(FaultTest, ByteLossCostsAFrame) {
  run("at_s=0.6,kind=byte_loss,count=3");
  EXPECT_NEAR(frames_missing(), 3.0, 1.0);
  EXPECT_GE(after.skipped.size(), 3U * 83U);
}

TEST_F(FaultTest, ByteFlipCostsAFrame) {
  run("at_s=0.6,kind=byte_flip,count=2,byte=40");
  EXPECT_NEAR(frames_missing(), 2.0, 1.0);
  EXPECT_GE(after.skipped.size(), 2U * 84U);
}

TEST_F(FaultTest, DuplicateFrameComesTwice) {
  run("at_s=0.6,kind=duplicate_frame");
  int twice = 0;
  for (std::size_t i = 1; i < after.frames.size(); ++i) {
    if (after.frames[i] == after.frames[i - 1]) ++twice;
  }
  EXPECT_EQ(twice, 1);
}

TEST_F(FaultTest, WrongLengthSpoilsTheSumAndTheLength) {
  run("at_s=0.6,kind=wrong_length");
  const Bytes wrong = {19, 82, 100};
  EXPECT_NE(std::search(after_bytes.begin(), after_bytes.end(), wrong.begin(), wrong.end()),
            after_bytes.end());
}

TEST_F(FaultTest, NineteenStandsInData) {
  run("at_s=0.6,kind=nineteen_in_data,for_s=0.3");
  int with_nineteen = 0;
  for (std::size_t i = 0; i < after.frames.size(); ++i) {
    if (after.byte(i, kTemperature) == 19 && word_at(after.frames[i], kLightLeft) == 0x1313) {
      ++with_nineteen;
    }
  }
  EXPECT_NEAR(with_nineteen, 20, 1) << "in whole frames with good sums";
}

TEST_F(FaultTest, SilenceLastsAsLongAsSaid) {
  run("at_s=0.6,kind=silence");
  EXPECT_NEAR(frames_missing(), 20.0, 2.0);
  const auto steps = deltas();
  EXPECT_NEAR(*std::max_element(steps.begin(), steps.end()), 0.3 * 0.1 / 0.000444565, 9.0)
      << "the robot drives on meanwhile";
}

TEST_F(FaultTest, HangUpTakesThePortAway) {
  run("at_s=0.6,kind=hang_up,for_s=0.2");
  EXPECT_NEAR(frames_missing(), 13.0, 2.0);
  EXPECT_TRUE(create->has_port());
}

TEST_F(FaultTest, RebootPutsTheBannerInMidStream) {
  run("at_s=0.6,kind=reboot");
  const std::string text(after_bytes.begin(), after_bytes.end());
  EXPECT_NE(text.find("Roomba by iRobot!"), std::string::npos);
  EXPECT_LT(after.frames.size(), 8U);
  EXPECT_EQ(create->interface().mode(), OiMode::kOff);
  EXPECT_EQ(create->motion().wheels().left.speed_mps, 0.0);
}

TEST_F(FaultTest, EncodersStartAnewAfterAReboot) {
  run("at_s=0.6,kind=reboot");
  while (create->now() < Duration(2'500'000)) create->step({}, after_bytes);
  after_bytes.clear();
  create->receive(Bytes{128, 149, 2, 43, 44});
  while (create->now() < Duration(2'600'000)) create->step({}, after_bytes);
  EXPECT_LT(word_at(after_bytes, 0), 30) << "braking only";
}

TEST_F(FaultTest, ModeDropStopsTheWheels) {
  run("at_s=0.6,kind=mode_drop");
  EXPECT_EQ(modes().front(), 2);
  EXPECT_EQ(modes().back(), 1);
  EXPECT_EQ(deltas().back(), 0);
}

TEST_F(FaultTest, Mode32IsReportedAndKept) {
  run("at_s=0.6,kind=mode_32");
  EXPECT_EQ(modes().back(), 32);
  create->receive(Bytes{131, 145, 0, 100, 0, 100});
  while (create->now() < Duration(2'000'000)) create->step({}, after_bytes);
  EXPECT_EQ(cut(after_bytes).frames.back().at(kMode), 32);
  EXPECT_EQ(create->motion().wheels().left.speed_mps, 0.0);
}

TEST_F(FaultTest, CountersRollOverForward) {
  run("at_s=0,kind=rollover_forward", {145, 1, 44, 1, 44});
  const auto seen = [&](const Received& received) {
    return word_at(received.frames.at(0), kEncoderLeft);
  };
  EXPECT_LT(static_cast<std::int16_t>(seen(before)), 0);
  EXPECT_GT(static_cast<std::int16_t>(word_at(after.frames.back(), kEncoderLeft)), 0);
  EXPECT_THAT(deltas(), ::testing::Each(::testing::AllOf(::testing::Ge(9), ::testing::Le(11))));
}

TEST_F(FaultTest, CountersRollOverBackward) {
  run("at_s=0,kind=rollover_backward", {145, 0xFE, 0xD4, 0xFE, 0xD4});
  EXPECT_GT(static_cast<std::int16_t>(word_at(before.frames.front(), kEncoderLeft)), 0);
  EXPECT_LT(static_cast<std::int16_t>(word_at(after.frames.back(), kEncoderLeft)), 0);
  EXPECT_THAT(deltas(), ::testing::Each(::testing::AllOf(::testing::Ge(-11), ::testing::Le(-9))));
}

TEST_F(FaultTest, StuckEncoderStandsWhileTheRobotDrives) {
  run("at_s=0.6,kind=encoder_stuck,side=left,for_s=0.6");
  const auto steps = deltas();
  EXPECT_NEAR(static_cast<double>(std::count(steps.begin(), steps.end(), 0)), 40.0, 2.0);
  EXPECT_LE(*std::max_element(steps.begin(), steps.end()), 4) << "what was missed stays missed";
  EXPECT_GT(create->motion().pose().x_m, 0.14);
}

TEST_F(FaultTest, BatteryFallsToFivePercent) {
  run("at_s=0.6,kind=battery_low");
  EXPECT_GT(word_at(before.frames.back(), kCharge), 2000);
  EXPECT_NEAR(word_at(after.frames.back(), kCharge), 0.05 * 2696.0, 2.0);
}

TEST_F(FaultTest, ChargerTripsSafe) {
  run("at_s=0.6,kind=charger");
  EXPECT_EQ(after.byte(after.frames.size() - 1, kChargingSource), 1);
  EXPECT_EQ(modes().back(), 1);
}

TEST_F(FaultTest, BumpIsHeldOnItsSideWhileTheRobotDrives) {
  run("at_s=0.6,kind=bump,side=left,for_s=0.3");
  int bumped = 0;
  for (std::size_t i = 0; i < after.frames.size(); ++i) bumped += after.byte(i, kBumps) == 2;
  EXPECT_NEAR(bumped, 20, 1);
  EXPECT_THAT(modes(), ::testing::Each(2));
}

TEST_F(FaultTest, WheelDropTripsSafe) {
  run("at_s=0.6,kind=wheel_drop,side=right");
  EXPECT_EQ(after.byte(after.frames.size() - 1, kBumps), 4);
  EXPECT_EQ(modes().back(), 1);
}

TEST_F(FaultTest, CliffAtHalfAMetreASecondTripsSafe) {
  run("at_s=0.6,kind=cliff,side=left", {145, 1, 244, 1, 244});
  EXPECT_EQ(after.byte(after.frames.size() - 1, kCliffLeft), 1);
  EXPECT_EQ(after.byte(after.frames.size() - 1, kCliffLeft + 3), 0);
  EXPECT_EQ(modes().back(), 1);
  EXPECT_EQ(create->motion().wheels().left.speed_mps, 0.0);
}

TEST(ParseFault, ReadsEveryEntry) {
  const Fault fault =
      parse_fault("at_s=3.5,kind=encoder_stuck,for_s=0.25,side=right,count=4,byte=7");
  EXPECT_EQ(fault.kind, FaultKind::kEncoderStuck);
  EXPECT_EQ(fault.at, Duration(3'500'000));
  EXPECT_EQ(fault.lasting, Duration(250'000));
  EXPECT_EQ(fault.sides, (LeftRight<bool>{false, true}));
  EXPECT_EQ(fault.count, 4);
  EXPECT_EQ(fault.at_byte, 7U);
}

TEST(ParseFault, KnowsHowLongAThingUsuallyLasts) {
  EXPECT_EQ(parse_fault("at_s=1,kind=silence").lasting, Duration(300'000));
}

TEST(ParseFault, RefusesWhatItDoesNotUnderstand) {
  const auto refuses = [](const char* text, const char* what) {
    EXPECT_THAT([&] { (void)parse_fault(text); },
                ThrowsMessage<std::runtime_error>(HasSubstr(what)))
        << text;
  };
  refuses("", "must have at_s and kind");
  refuses("at_s=1", "must have at_s and kind");
  refuses("kind=bump", "must have at_s and kind");
  refuses("at_s=1,kind=melt", "kind must be one of byte_loss");
  refuses("at_s=x,kind=bump", "\"x\" must be a number");
  refuses("at_s=-1,kind=bump", "must be a number in [0");
  refuses("at_s=nan,kind=bump", "must be a number");
  refuses("at_s=1,kind=bump,side=up", "side must be left, right or both");
  refuses("at_s=1,kind=bump,depth=2", "\"depth\" must be one of");
  refuses("at_s=1,kind", "entries must be key=value");
  refuses("at_s=1,kind=byte_loss,count=0", "must be a number in [1");
}

}  // namespace
}  // namespace roomwise::simulator
