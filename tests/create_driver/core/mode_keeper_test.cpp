#include "services/create_driver/core/mode_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A ModeKeeper and the robot it talks to, in steps of 5 ms.
class Talk {
 public:
  explicit Talk(Model model = Model::kCreate2, OiMode target = OiMode::kSafe)
      : keeper(model, target, {100}) {
    keeper.begin(now);
  }

  void run(Duration time) {
    for (const Duration end = now + time; now < end; now += milliseconds(5)) step();
  }
  std::int64_t count(DriverEvent event) const { return counts[event]; }
  bool was_sent(std::uint8_t byte) const {
    return std::find(sent.begin(), sent.end(), byte) != sent.end();
  }

  ModeKeeper keeper;
  DriverCounts counts;
  Bytes sent;
  SensorPackets packets;
  int mode_byte = 0;     // what the robot reports
  int passive_byte = 1;  // what Start leads to
  int safe_byte = 2;     // what Safe leads to
  int full_byte = 3;     // what Full leads to
  bool is_deaf = false;  // hears and says nothing
  bool is_streaming = false;
  Wish wish = Wish::kStand;
  Duration now = std::chrono::hours(1);
  Duration mode_command_at{};
  Duration spacing = seconds(1);  // shortest silence after a mode command

 private:
  void step() {
    if (is_streaming && !is_deaf) {
      packets.set(Packet::kOiMode, mode_byte);
      keeper.see(now, packets);
    }
    Bytes bytes;
    keeper.step(now, wish, counts, bytes);
    if (!bytes.empty() && now > mode_command_at) {
      spacing = std::min(spacing, now - mode_command_at);
    }
    sent.insert(sent.end(), bytes.begin(), bytes.end());
    if (!is_deaf && !bytes.empty()) obey(bytes);
  }
  void obey(const Bytes& bytes) {
    if (bytes[0] == 148) is_streaming = mode_byte != 0;
    if (bytes[0] == 7) {
      mode_byte = 0;
      is_streaming = false;
    }
    if (bytes.back() == 128) set_mode(passive_byte);
    if (bytes.back() == 131) set_mode(safe_byte);
    if (bytes.back() == 132) set_mode(full_byte);
  }
  void set_mode(int byte) {
    mode_byte = byte;
    mode_command_at = now;
  }
};

TEST(ModeKeeper, TakesASleepingRobotToSafe) {
  Talk talk;
  talk.run(milliseconds(300));
  EXPECT_TRUE(talk.keeper.may_drive());
  EXPECT_EQ(talk.keeper.mode(), OiMode::kSafe);
  EXPECT_FALSE(talk.was_sent(132));
  EXPECT_GE(talk.spacing, milliseconds(20));
}

TEST(ModeKeeper, FullIsEnteredOnlyWhenItIsTheTarget) {
  Talk talk(Model::kCreate2, OiMode::kFull);
  talk.run(milliseconds(300));
  EXPECT_TRUE(talk.keeper.may_drive());
  EXPECT_EQ(talk.keeper.mode(), OiMode::kFull);
  EXPECT_FALSE(talk.was_sent(131));
}

TEST(ModeKeeper, BeginsByStoppingTheRobot) {
  Talk talk;
  talk.run(milliseconds(5));
  EXPECT_EQ(talk.sent, Bytes(kStopAndRest.begin(), kStopAndRest.end()));
}

TEST(ModeKeeper, ARobotThatDoesNotAnswerIsWokenAndAskedAgain) {
  Talk talk;
  talk.is_deaf = true;
  talk.run(milliseconds(1200));
  EXPECT_TRUE(talk.keeper.pulls_wake_line(talk.now));
  talk.run(milliseconds(1000));
  EXPECT_FALSE(talk.keeper.pulls_wake_line(talk.now));
  EXPECT_EQ(talk.count(DriverEvent::kRobotSilent), 1);
  talk.is_deaf = false;
  talk.run(seconds(2));
  EXPECT_TRUE(talk.keeper.may_drive());
}

TEST(ModeKeeper, AWakePulseIsTooLongToSetTheBaudRate) {
  Talk talk;
  talk.is_deaf = true;
  Duration pulse{};
  for (int i = 0; i < 1000; ++i) {
    talk.run(milliseconds(5));
    if (talk.keeper.pulls_wake_line(talk.now)) pulse += milliseconds(5);
    if (pulse > Duration(0) && !talk.keeper.pulls_wake_line(talk.now)) break;
  }
  EXPECT_GT(pulse, milliseconds(500));
}

TEST(ModeKeeper, GoesBackAfterATripHalfASecondLater) {
  Talk talk;
  talk.run(milliseconds(300));
  talk.mode_byte = 1;
  talk.run(milliseconds(400));
  EXPECT_FALSE(talk.keeper.may_drive());
  EXPECT_TRUE(talk.keeper.is_held());
  talk.run(milliseconds(300));
  EXPECT_TRUE(talk.keeper.may_drive());
  EXPECT_EQ(talk.keeper.mode_drops(), 1);
}

TEST(ModeKeeper, AHangingWheelOrAChargerPlugKeepsItFromDriving) {
  for (const auto& [packet, bits] :
       {std::pair(Packet::kBumpsAndDrops, 4), std::pair(Packet::kBumpsAndDrops, 8),
        std::pair(Packet::kBumpsAndDrops, 16), std::pair(Packet::kChargingSources, 1)}) {
    Talk talk;
    talk.wish = Wish::kForward;
    talk.packets.set(packet, bits);
    talk.run(seconds(3));
    EXPECT_FALSE(talk.keeper.may_drive()) << bits;
    EXPECT_TRUE(talk.keeper.is_held());
    EXPECT_FALSE(talk.was_sent(131));
    talk.packets.set(packet, 0);
    talk.run(milliseconds(100));
    EXPECT_TRUE(talk.keeper.may_drive()) << bits;
  }
}

TEST(ModeKeeper, AtAnEdgeItDoesNotCreepForward) {
  for (const Packet sensor : {Packet::kCliffLeft, Packet::kCliffFrontLeft, Packet::kCliffFrontRight,
                              Packet::kCliffRight}) {
    Talk talk;
    talk.wish = Wish::kForward;
    talk.run(milliseconds(300));
    talk.packets.set(sensor, 1);
    talk.mode_byte = 1;  // it trips
    talk.run(seconds(3));
    EXPECT_FALSE(talk.keeper.may_drive());
    talk.wish = Wish::kBackOrTurn;
    talk.run(milliseconds(100));
    EXPECT_TRUE(talk.keeper.may_drive());
  }
}

TEST(ModeKeeper, BumpersDoNotKeepItFromDriving) {
  Talk talk;
  talk.packets.set(Packet::kBumpsAndDrops, 3);
  talk.run(milliseconds(300));
  EXPECT_TRUE(talk.keeper.may_drive());
}

TEST(ModeKeeper, OnItsHomeBaseItRestsUntilItIsAskedToMove) {
  Talk talk;
  talk.packets.set(Packet::kChargingSources, 2);
  talk.run(seconds(1));
  EXPECT_FALSE(talk.keeper.may_drive());
  talk.wish = Wish::kForward;
  talk.run(milliseconds(100));
  EXPECT_TRUE(talk.keeper.may_drive());
}

TEST(ModeKeeper, UnderstandsARobotThatReportsOneMore) {
  Talk talk;
  talk.passive_byte = 2;
  talk.safe_byte = 3;
  talk.run(milliseconds(500));
  EXPECT_TRUE(talk.keeper.may_drive());
  EXPECT_EQ(talk.keeper.mode(), OiMode::kSafe);
  EXPECT_EQ(talk.count(DriverEvent::kModeByteOffset), 1);
}

TEST(ModeKeeper, ARobotThatMissedStartIsNotTakenForOneThatReportsOneMore) {
  Talk talk;
  talk.mode_byte = 2;  // left in Safe by whoever drove it before
  talk.is_streaming = true;
  talk.is_deaf = true;
  talk.run(milliseconds(10));
  talk.is_deaf = false;
  talk.run(milliseconds(500));
  EXPECT_TRUE(talk.keeper.may_drive());
  EXPECT_EQ(talk.count(DriverEvent::kModeByteOffset), 0);
}

TEST(ModeKeeper, ResetsARobotInModeThirtyTwo) {
  Talk talk;
  talk.run(milliseconds(300));
  talk.mode_byte = 32;
  talk.run(milliseconds(50));
  EXPECT_TRUE(talk.was_sent(7));
  EXPECT_EQ(talk.count(DriverEvent::kModeUnknown), 1);
  EXPECT_EQ(talk.count(DriverEvent::kRobotReset), 1);
  talk.keeper.robot_boots(talk.now);
  talk.run(seconds(1));
  EXPECT_TRUE(talk.keeper.may_drive());
}

TEST(ModeKeeper, ResetsAtMostEveryTenSeconds) {
  Talk talk;
  talk.passive_byte = 32;  // it stays so, whatever is done
  talk.run(seconds(60));
  EXPECT_FALSE(talk.keeper.may_drive());
  EXPECT_GE(talk.count(DriverEvent::kRobotReset), 2);
  EXPECT_LE(talk.count(DriverEvent::kRobotReset), 6);
}

TEST(ModeKeeper, ACreateOneHasNoResetAndIsStartedAgain) {
  Talk talk(Model::kCreate1);
  talk.run(milliseconds(300));
  talk.mode_byte = 32;
  talk.run(seconds(3));
  EXPECT_FALSE(talk.was_sent(7));
  EXPECT_TRUE(talk.keeper.may_drive());
}

TEST(ModeKeeper, ARobotThatRefusesItsModeIsStartedAgain) {
  Talk talk;
  talk.safe_byte = 1;
  talk.run(seconds(10));
  EXPECT_FALSE(talk.keeper.may_drive());
  EXPECT_GE(talk.count(DriverEvent::kModeRefused), 6);
  EXPECT_GE(std::count(talk.sent.begin(), talk.sent.end(), 128), 3);
}

TEST(ModeKeeper, SilenceOfHalfASecondStartsItAgain) {
  Talk talk;
  talk.run(milliseconds(300));
  talk.is_deaf = true;
  talk.run(milliseconds(400));
  EXPECT_TRUE(talk.keeper.may_drive());
  talk.run(milliseconds(200));
  EXPECT_FALSE(talk.keeper.may_drive());
  EXPECT_EQ(talk.count(DriverEvent::kRobotSilent), 1);
  talk.is_deaf = false;
  talk.run(milliseconds(500));
  EXPECT_TRUE(talk.keeper.may_drive());
}

TEST(ModeKeeper, ABootingRobotIsLeftAloneUntilItsTextEnds) {
  Talk talk;
  talk.run(milliseconds(300));
  talk.sent.clear();
  for (int i = 0; i < 10; ++i) {
    talk.keeper.robot_boots(talk.now);
    talk.mode_byte = 0;
    talk.is_streaming = false;
    talk.run(milliseconds(300));
  }
  EXPECT_TRUE(talk.sent.empty());
  talk.run(seconds(1));
  EXPECT_TRUE(talk.keeper.may_drive());
}

}  // namespace
}  // namespace roomwise::create
