#include "services/create_driver/device/guardian.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <stdexcept>
#include <thread>

#include "services/create_driver/core/oi_encoder.h"
#include "services/create_driver/device/serial_port.h"
#include "tests/create_driver/support/scripted_robot.h"
#include "tests/support/build_paths.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;

/// A robot that was told to drive, and the guardian of its port.
class GuardianTest : public ::testing::Test {
 protected:
  void SetUp() override {
    robot_.emplace(folder_.path() / "create");
    port_.emplace(folder_.path() / "create", 115200);
    guardian_.emplace(program("create_guardian"), port_->fd());
    Bytes bytes{128, 131};
    append_drive({0.2, 0.2}, bytes);
    ASSERT_TRUE(guardian_->beat());
    ASSERT_TRUE(port_->write(bytes));
    ASSERT_TRUE(beat_until([&] { return drives(); }));
  }
  bool drives() const { return robot_->wheels() != ScriptedRobot::Wheels{}; }

  /// Beats every 10 ms until `condition`, or for some seconds.
  template <class Condition>
  bool beat_until(Condition condition) {
    for (int i = 0; i < 500; ++i) {
      if (condition()) return true;
      if (!guardian_->beat()) return false;
      std::this_thread::sleep_for(milliseconds(10));
    }
    return false;
  }
  template <class Condition>
  static bool wait_until(Condition condition) {
    for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(milliseconds(10));
    return condition();
  }

  ScratchFolder folder_;
  std::optional<ScriptedRobot> robot_;
  std::optional<SerialPort> port_;
  std::optional<Guardian> guardian_;
};

TEST_F(GuardianTest, LetsTheRobotDriveWhileTheDriverBeats) {
  int beats = 0;
  EXPECT_TRUE(beat_until([&] { return ++beats > 50; }));
  EXPECT_TRUE(drives());
}

TEST_F(GuardianTest, StopsTheRobotWhenTheBeatsEnd) {
  EXPECT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }));
  EXPECT_FALSE(drives());
}

TEST_F(GuardianTest, ACommandCutShortDoesNotSwallowTheStop) {
  ASSERT_TRUE(port_->write(Bytes{145, 0x01}));
  EXPECT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }));
  EXPECT_FALSE(drives());
}

TEST_F(GuardianTest, GuardsAgainWhenTheBeatsComeBack) {
  ASSERT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }));
  std::this_thread::sleep_for(milliseconds(200));
  ASSERT_TRUE(guardian_->beat());
  Bytes bytes{131};
  append_drive({0.1, 0.1}, bytes);
  ASSERT_TRUE(port_->write(bytes));
  ASSERT_TRUE(beat_until([&] { return drives(); }));
  EXPECT_TRUE(wait_until([&] { return !drives(); }));
}

TEST_F(GuardianTest, HeedsNoSignalThatCanBeRefused) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGPIPE}) {
    ASSERT_EQ(::kill(guardian_->pid(), signal), 0);
  }
  int beats = 0;
  EXPECT_TRUE(beat_until([&] { return ++beats > 20; }));
}

TEST_F(GuardianTest, IsOutsideTheDriversSession) {
  EXPECT_EQ(::getsid(guardian_->pid()), guardian_->pid());
}

TEST_F(GuardianTest, ItsDeathIsNoticed) {
  ::kill(guardian_->pid(), SIGKILL);
  EXPECT_TRUE(wait_until([&] { return !guardian_->beat(); }));
}

TEST_F(GuardianTest, ItsFreezingIsNoticed) {
  ::kill(guardian_->pid(), SIGSTOP);
  EXPECT_TRUE(wait_until([&] { return !guardian_->beat(); }));
}

TEST_F(GuardianTest, LettingGoStopsTheRobotAndFreesThePort) {
  port_.reset();
  guardian_.reset();
  EXPECT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }));
  EXPECT_NO_THROW(SerialPort(folder_.path() / "create", 115200));
}

TEST_F(GuardianTest, AnUnpluggedRobotDoesNotHoldItUp) {
  robot_.reset();
  const pid_t pid = guardian_->pid();
  guardian_.reset();
  EXPECT_NE(::kill(pid, 0), 0);
}

TEST(GuardianStart, AMissingProgramIsAnError) {
  EXPECT_THROW(Guardian("/nowhere/create_guardian", 0), std::runtime_error);
}

}  // namespace
}  // namespace roomwise::create
