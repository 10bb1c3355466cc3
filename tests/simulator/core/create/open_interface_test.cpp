#include "services/simulator/core/create/open_interface.h"

#include <gtest/gtest.h>

#include "tests/simulator/core/create/oi_host.h"

namespace roomwise::simulator {
namespace {

using Wheels = LeftRight<double>;

OpenInterfaceParams create1() {
  OpenInterfaceParams params;
  params.model = "create1";
  return params;
}

class OpenInterfaceTest : public ::testing::Test {
 protected:
  void go(OiMode mode) {
    host.send({128});
    if (mode == OiMode::kSafe) host.send({131});
    if (mode == OiMode::kFull) host.send({132});
    ASSERT_EQ(host.interface.mode(), mode);
  }
  Wheels wheels() const { return host.interface.wheel_command_mps(); }
  void drive_ahead() { host.send({145, 0, 200, 0, 200}); }

  OiHost host;
};

TEST_F(OpenInterfaceTest, OffAnswersOnlyStart) {
  EXPECT_TRUE(host.ask({142, 35}).empty());
  host.send({131, 132, 137, 0, 100, 0x7F, 0xFF});
  EXPECT_EQ(host.interface.mode(), OiMode::kOff);
  host.send({128});
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
  EXPECT_EQ(host.ask({142, 35}), Bytes{1});
}

TEST_F(OpenInterfaceTest, ModeCommandsChangeMode) {
  go(OiMode::kPassive);
  for (const auto& [command, mode] : {std::pair{131, 2}, {132, 3}, {131, 2}, {128, 1}, {130, 2}}) {
    host.send({static_cast<std::uint8_t>(command)});
    EXPECT_EQ(host.mode_byte(), mode) << command;
  }
  host.send({132, 130});
  EXPECT_EQ(host.mode_byte(), 3) << "Control is heard in Passive only";
}

TEST_F(OpenInterfaceTest, DriveInPassiveIsIgnored) {
  go(OiMode::kPassive);
  drive_ahead();
  EXPECT_EQ(wheels(), Wheels{});
  host.send({131});
  EXPECT_EQ(wheels(), Wheels{}) << "not remembered either";
}

TEST_F(OpenInterfaceTest, DriveDirectTakesTheRightWheelFirst) {
  go(OiMode::kSafe);
  host.send({145, 0xFF, 0x38, 0x00, 0x64});
  EXPECT_DOUBLE_EQ(wheels().right, -0.2);
  EXPECT_DOUBLE_EQ(wheels().left, 0.1);
  EXPECT_EQ(host.ask({149, 2, 41, 42}), (Bytes{0xFF, 0x38, 0x00, 0x64}));
}

TEST_F(OpenInterfaceTest, DriveFollowsAnArc) {
  go(OiMode::kSafe);
  host.send({137, 255, 56, 1, 244});  // -200 mm/s, radius 500 mm
  EXPECT_NEAR(wheels().left, -0.2 * (1.0 - 0.1175 / 0.5), 1e-12);
  EXPECT_NEAR(wheels().right, -0.2 * (1.0 + 0.1175 / 0.5), 1e-12);
  EXPECT_EQ(host.ask({149, 2, 39, 40}), (Bytes{255, 56, 1, 244}));
}

TEST_F(OpenInterfaceTest, DriveKnowsItsSpecialRadii) {
  go(OiMode::kFull);
  const auto drive = [&](std::uint8_t high, std::uint8_t low) {
    host.send({137, 0, 100, high, low});
    return wheels();
  };
  EXPECT_EQ(drive(0x80, 0x00), (Wheels{0.1, 0.1}));
  EXPECT_EQ(drive(0x7F, 0xFF), (Wheels{0.1, 0.1}));
  EXPECT_EQ(drive(0xFF, 0xFF), (Wheels{0.1, -0.1})) << "clockwise";
  EXPECT_EQ(drive(0x00, 0x01), (Wheels{-0.1, 0.1})) << "counter-clockwise";
}

TEST_F(OpenInterfaceTest, ATightArcIsDrivenSlowerAndKeepsItsRadius) {
  go(OiMode::kSafe);
  host.send({137, 1, 244, 0, 100});  // 500 mm/s, radius 100 mm
  EXPECT_NEAR(wheels().right, 0.5, 1e-12);
  EXPECT_NEAR((wheels().right + wheels().left) / (wheels().right - wheels().left) * 0.235 / 2.0,
              0.1, 1e-12);
}

TEST_F(OpenInterfaceTest, SpeedsAreClamped) {
  go(OiMode::kSafe);
  host.send({145, 0x7F, 0xFF, 0x80, 0x00});
  EXPECT_EQ(wheels(), (Wheels{-0.5, 0.5}));
  host.send({146, 0x7F, 0xFF, 0xFF, 0x01});  // 255 and -255
  EXPECT_DOUBLE_EQ(wheels().right, 0.5);
  EXPECT_DOUBLE_EQ(wheels().left, -0.5);
}

TEST_F(OpenInterfaceTest, LastCommandHoldsForEver) {
  go(OiMode::kFull);
  drive_ahead();
  host.wait(66 * 1200);  // twenty minutes
  EXPECT_EQ(wheels(), (Wheels{0.2, 0.2}));
  EXPECT_EQ(host.interface.mode(), OiMode::kFull);
}

TEST_F(OpenInterfaceTest, StreamComesEvery15MsUntilPaused) {
  go(OiMode::kPassive);
  host.readings.cliff_signal[1] = 537;
  host.send({148, 2, 29, 13});
  const auto frames = host.wait(10);
  ASSERT_EQ(frames.size(), 10U);
  for (const Transmission& frame : frames) {
    EXPECT_TRUE(frame.is_frame);
    EXPECT_EQ(frame.bytes, (Bytes{19, 5, 29, 2, 25, 13, 0, 163})) << "the specification's example";
  }
  host.send({150, 0});
  EXPECT_TRUE(host.wait(10).empty());
  host.send({150, 1});
  EXPECT_EQ(host.wait(10).size(), 10U);
  EXPECT_EQ(host.ask({142, 38}), Bytes{2});
}

TEST_F(OpenInterfaceTest, WholeStateFitsAStreamFrameAndSums) {
  go(OiMode::kPassive);
  host.readings.voltage_mv = 16123;
  host.send({148, 1, 100});
  const auto frames = host.wait(1);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].bytes.size(), 84U);
  EXPECT_EQ(frames[0].bytes[1], 81);
  EXPECT_TRUE(sums_to_zero(frames[0].bytes));
}

TEST_F(OpenInterfaceTest, OldManualsChecksumLeavesTheHeaderOut) {
  OpenInterfaceParams params = create1();
  params.checksum = "without_header";
  OiHost old(params);
  old.readings.cliff_signal[1] = 537;
  old.send({128, 148, 2, 29, 13});
  EXPECT_EQ(old.wait(1).at(0).bytes, (Bytes{19, 5, 29, 2, 25, 13, 0, 182}));
}

TEST_F(OpenInterfaceTest, StreamTooLongForItsSlotIsCutShort) {
  OiHost slow(create1());
  slow.send({128, 148, 3, 6, 6, 6});  // 3 * 53 + 3 bytes; 57600 baud carries 86
  const auto frames = slow.wait(2);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].bytes.size(), 86U);
  EXPECT_FALSE(sums_to_zero(frames[0].bytes));
}

TEST_F(OpenInterfaceTest, BaudChangeShrinksTheSlot) {
  go(OiMode::kPassive);
  host.send({129, 7, 148, 1, 100});
  EXPECT_EQ(host.interface.baud(), 19200);
  EXPECT_EQ(host.wait(1).at(0).bytes.size(), 28U);
  host.send({129, 12});
  EXPECT_EQ(host.interface.baud(), 19200) << "there is no code 12";
}

TEST_F(OpenInterfaceTest, UnknownBytesAreSkipped) {
  go(OiMode::kSafe);
  host.send({0, 1, 6, 127, 159, 200, 255, 151});
  EXPECT_EQ(host.ask({142, 35}), Bytes{2});
}

TEST_F(OpenInterfaceTest, ResetPrintsTheBannerAndIsDeafMeanwhile) {
  go(OiMode::kSafe);
  drive_ahead();
  host.send({129, 7});
  host.send({7});
  EXPECT_EQ(host.interface.mode(), OiMode::kOff);
  EXPECT_EQ(host.interface.baud(), 115200) << "kept only until the power goes";
  EXPECT_EQ(wheels(), Wheels{});
  const auto said = host.wait(20);
  ASSERT_EQ(said.size(), 1U);
  const std::string banner(said[0].bytes.begin(), said[0].bytes.end());
  EXPECT_NE(banner.find("release-stm32-3.7.7"), std::string::npos);
  host.send({128});
  EXPECT_EQ(host.interface.mode(), OiMode::kOff) << "still booting";
  host.wait(100);
  host.send({128});
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
}

TEST_F(OpenInterfaceTest, StopEndsStreamAndGoesOff) {
  go(OiMode::kSafe);
  drive_ahead();
  host.send({148, 1, 7, 173});
  EXPECT_EQ(host.interface.mode(), OiMode::kOff);
  EXPECT_EQ(wheels(), Wheels{});
  EXPECT_TRUE(host.wait(5).empty());
}

TEST_F(OpenInterfaceTest, SleepsAfterFiveMinutesInPassiveOnly) {
  go(OiMode::kPassive);
  host.send({148, 1, 7});
  EXPECT_EQ(host.wait(19'999).size(), 19'999U) << "300 s less a frame";
  EXPECT_TRUE(host.wait(10).empty());
  host.send({128});
  EXPECT_EQ(host.interface.mode(), OiMode::kOff) << "deaf";
  host.interface.press_power_button();
  host.send({128, 131});
  EXPECT_EQ(host.interface.mode(), OiMode::kSafe);
  host.wait(40'000);
  EXPECT_EQ(host.interface.mode(), OiMode::kSafe);
}

TEST_F(OpenInterfaceTest, ModeCommandsKeepItAwake) {
  go(OiMode::kPassive);
  for (int minute = 0; minute < 10; ++minute) {
    host.wait(4'000);
    host.send({128});
  }
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
}

TEST_F(OpenInterfaceTest, PowerPutsItToSleep) {
  go(OiMode::kFull);
  host.send({133, 128});
  EXPECT_EQ(host.interface.mode(), OiMode::kOff);
}

TEST_F(OpenInterfaceTest, CleaningMovesInPassiveUntilAModeCommand) {
  go(OiMode::kSafe);
  host.send({135});
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
  EXPECT_GT(wheels().left, 0.0);
  drive_ahead();
  EXPECT_NE(wheels(), (Wheels{0.2, 0.2}));
  host.send({131});
  EXPECT_EQ(wheels(), Wheels{});
}

TEST_F(OpenInterfaceTest, BytesTooSoonAfterAModeCommandAreLost) {
  OpenInterfaceParams params;
  params.mode_settle_s = 0.02;
  OiHost strict(params);
  strict.send({128, 131});
  EXPECT_EQ(strict.interface.mode(), OiMode::kPassive);
  strict.wait(2);
  strict.send({131});
  EXPECT_EQ(strict.interface.mode(), OiMode::kSafe);
}

TEST_F(OpenInterfaceTest, ModeByteMayBeOneTooHigh) {
  OpenInterfaceParams params;
  params.mode_byte = "plus_one";
  OiHost odd(params);
  odd.send({128});
  EXPECT_EQ(odd.mode_byte(), 2);
  odd.send({132});
  EXPECT_EQ(odd.mode_byte(), 4);
}

TEST_F(OpenInterfaceTest, SongPlaysAsLongAsItsNotes) {
  go(OiMode::kSafe);
  host.send({140, 3, 2, 60, 32, 62, 32, 141, 3});
  EXPECT_EQ(host.ask({149, 2, 36, 37}), (Bytes{3, 1}));
  host.wait(60);
  EXPECT_EQ(host.ask({142, 37}), Bytes{1});
  host.wait(10);
  EXPECT_EQ(host.ask({142, 37}), Bytes{0});
}

TEST(CreateOne, KnowsNoEncodersAndNoReset) {
  OiHost host(create1());
  host.send({128});
  EXPECT_TRUE(host.ask({142, 43}).empty());
  EXPECT_TRUE(host.ask({142, 100}).empty());
  EXPECT_EQ(host.ask({142, 6}).size(), 52U);
  host.send({7});
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
}

TEST(CreateOne, DemoTakesAByte) {
  OiHost host(create1());
  host.send({128, 136, 128});
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
  EXPECT_GT(host.interface.wheel_command_mps().left, 0.0);
}

TEST(CreateOne, IgnoresItsHostDuringAWait) {
  OiHost host(create1());
  host.send({128, 131, 155, 10});
  host.send({145, 0, 100, 0, 100});
  EXPECT_EQ(host.interface.wheel_command_mps(), Wheels{});
  host.wait(70);
  host.send({145, 0, 100, 0, 100});
  EXPECT_EQ(host.interface.wheel_command_mps(), (Wheels{0.1, 0.1}));
}

TEST(CreateOne, ScriptDrivesUntilADistance) {
  OiHost host(create1());
  host.send({128, 131, 152, 13, 137, 0, 100, 128, 0, 156, 0, 200, 137, 0, 0, 0, 0});
  EXPECT_EQ(host.ask({154}), (Bytes{13, 137, 0, 100, 128, 0, 156, 0, 200, 137, 0, 0, 0, 0}));
  host.send({153});
  host.wait(1);
  EXPECT_EQ(host.interface.wheel_command_mps(), (Wheels{0.1, 0.1}));
  host.readings.turned_m = {0.19, 0.19};
  host.wait(2);
  EXPECT_EQ(host.interface.wheel_command_mps(), (Wheels{0.1, 0.1}));
  host.readings.turned_m = {0.2, 0.2};
  host.wait(2);
  EXPECT_EQ(host.interface.wheel_command_mps(), Wheels{});
}

TEST(CreateOne, AScriptThatCallsItselfDoesNotHang) {
  OiHost host(create1());
  host.send({128, 152, 1, 153, 153});
  host.wait(3);
  EXPECT_EQ(host.ask({142, 35}), Bytes{1});
}

TEST(CreateOne, WaitsForAnEventAndForItsEnd) {
  OiHost host(create1());
  host.send({128, 158, 5, 131});
  host.wait(2);
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
  host.readings.bump.left = true;
  host.wait(2);
  host.send({158, 0xFB, 132});  // until the bump ends
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
  host.readings.bump.left = false;
  host.wait(2);
  host.send({132});
  EXPECT_EQ(host.interface.mode(), OiMode::kFull);
}

}  // namespace
}  // namespace roomwise::simulator
