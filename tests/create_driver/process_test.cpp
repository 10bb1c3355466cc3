// The real create_driver and its guardian on a pseudo-terminal, over real LCM in a private network.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <thread>

#include "common/bus/lcm_bus.h"
#include "common/channels.h"
#include "tests/create_driver/support/scripted_robot.h"
#include "tests/support/drive_command.h"
#include "tests/support/private_network.h"
#include "tests/system/live_service.h"

namespace roomwise {
namespace {

using create::OiMode;
using create::ScriptedRobot;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// The program under test: it must stop within this, whatever happens to the driver.
constexpr auto kStopLimit = milliseconds(300);

bool wait_until(const std::function<bool()>& condition, int patience_s = 20) {
  const auto end = Clock::now() + std::chrono::seconds(patience_s);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return true;
}

std::int64_t wall_utime() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Publishes VEL_CMD at 50 Hz as safety_svc does, until it goes.
class CommandSource {
 public:
  CommandSource(const SecretKey& key, double speed_mps, double turn_rate_radps)
      : key_(key),
        thread_([this, speed_mps, turn_rate_radps] { run(speed_mps, turn_rate_radps); }) {}
  ~CommandSource() { stop(); }
  void stop() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  void run(double speed_mps, double turn_rate_radps) {
    LcmBus bus(kTestUrl);
    const std::int64_t session = wall_utime();
    std::int64_t sequence = 0;
    while (!is_over_) {
      auto command =
          drive_command(key_, wall_utime(), session, ++sequence, speed_mps, turn_rate_radps);
      bus.publish(channels::kVelCmd, command);
      std::this_thread::sleep_for(milliseconds(20));
    }
  }
  SecretKey key_;
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

class CreateDriverProcess : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  void SetUp() override {
    std::ofstream(folder_.path() / "params.toml")
        << "port = \"" << port().string() << "\"\n"
        << "key_path = \"" << (folder_.path() / "key").string() << "\"\n";
    robot_.emplace(port());
    start_driver();
  }
  std::filesystem::path port() const { return folder_.path() / "create"; }

  void start_driver() {
    driver_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{program("create_driver"), "--url", kTestUrl, "--params",
                                 (folder_.path() / "params.toml").string()},
        folder_.path() / "output");
  }
  bool drives() { return robot_->wheels() != ScriptedRobot::Wheels{}; }

  /// How long after `since` the wheels stood, if they do within some seconds.
  std::optional<Clock::duration> time_to_stop(Clock::time_point since) {
    if (!wait_until([&] { return !drives(); }, 5)) return std::nullopt;
    const auto time = robot_->stopped_at() - since;
    RecordProperty("stopped_after_ms", std::to_string(time / milliseconds(1)));
    return time;
  }

  ScratchFolder folder_;
  SecretKey key_ = make_key_file(folder_.path() / "key");
  std::optional<ScriptedRobot> robot_;
  std::unique_ptr<ChildProcess> driver_;
};

TEST_F(CreateDriverProcess, DrivesAsCommandedAndStopsWhenCommandsEnd) {
  CommandSource source(key_, 0.2, 0.5);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  EXPECT_EQ(robot_->mode(), OiMode::kSafe);
  EXPECT_EQ(robot_->wheels(), (ScriptedRobot::Wheels{141, 259}));  // 0.2 -+ 0.5 * 0.235 / 2
  source.stop();
  const auto stop = time_to_stop(Clock::now());
  ASSERT_TRUE(stop.has_value());
  EXPECT_LT(*stop, kStopLimit);
  EXPECT_EQ(robot_->mode(), OiMode::kSafe);
}

TEST_F(CreateDriverProcess, PublishesStateAndOdometry) {
  const CommandSource source(key_, 0.2, 0.0);
  LcmBus bus(kTestUrl);
  create_state_t state{};
  odometry_t odometry{};
  bus.subscribe(channels::kCreateState, [&](const create_state_t& message) { state = message; });
  bus.subscribe(channels::kOdometry, [&](const odometry_t& message) {
    odometry = message;
    if (message.x_m > 0.1) bus.stop();
  });
  const auto give_up = Clock::now() + std::chrono::seconds(20);
  bus.every(milliseconds(100), [&](Time) {
    if (Clock::now() > give_up) bus.stop();
  });
  bus.run();
  EXPECT_GT(odometry.x_m, 0.1);
  EXPECT_EQ(odometry.source, odometry_t::SOURCE_WHEELS);
  EXPECT_EQ(odometry.y_m, 0.0);
  EXPECT_NEAR(static_cast<double>(wall_utime() - odometry.utime), 0.0, 1e6);
  EXPECT_EQ(state.driver_state, create_state_t::DRIVER_DRIVING);
  EXPECT_EQ(state.mode, create_state_t::MODE_SAFE);
  EXPECT_DOUBLE_EQ(state.battery_v, 14.5);
  EXPECT_DOUBLE_EQ(state.commanded_left_mps, 0.2);
}

TEST_F(CreateDriverProcess, KilledDriverLeavesAStoppedRobotInPassive) {
  const CommandSource source(key_, 0.3, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  const auto killed = Clock::now();
  driver_->send_signal(SIGKILL);
  const auto stop = time_to_stop(killed);
  ASSERT_TRUE(stop.has_value());
  EXPECT_LT(*stop, kStopLimit);
  EXPECT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }));
}

TEST_F(CreateDriverProcess, AKilledDriverStartedAgainDrivesAgain) {
  const CommandSource source(key_, 0.3, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  driver_->send_signal(SIGKILL);
  driver_->wait();
  start_driver();
  ASSERT_TRUE(wait_until([&] { return !drives(); }));
  EXPECT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
}

TEST_F(CreateDriverProcess, FrozenDriverIsStoppedAndGoesThroughStartUpWhenThawed) {
  const CommandSource source(key_, 0.3, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  const auto frozen = Clock::now();
  driver_->send_signal(SIGSTOP);
  const auto stop = time_to_stop(frozen);
  ASSERT_TRUE(stop.has_value());
  EXPECT_LT(*stop, kStopLimit);
  ASSERT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }));

  std::this_thread::sleep_for(milliseconds(400));
  EXPECT_EQ(robot_->mode(), OiMode::kPassive);
  const std::size_t before = robot_->opcodes().size();
  driver_->send_signal(SIGCONT);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  // Nothing that drives comes before Start, the stream and Safe.
  std::vector<std::uint8_t> since = robot_->opcodes();
  since.erase(since.begin(), since.begin() + static_cast<std::ptrdiff_t>(before));
  const auto start = std::find(since.begin(), since.end(), 128);
  const auto stream = std::find(start, since.end(), 148);
  EXPECT_NE(std::find(stream, since.end(), 131), since.end());
}

TEST_F(CreateDriverProcess, EverySignalToEndLeavesAStoppedRobotInPassive) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const CommandSource source(key_, -0.1, 0.4);
    ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
    driver_->send_signal(signal);
    EXPECT_EQ(driver_->wait(), 0) << driver_->output();
    EXPECT_TRUE(wait_until([&] { return robot_->mode() == OiMode::kPassive; }, 1));
    EXPECT_FALSE(drives());
    start_driver();
  }
}

TEST_F(CreateDriverProcess, RobotUnpluggedAndPluggedInAgainIsTakenUp) {
  const CommandSource source(key_, 0.2, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  robot_.reset();
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_TRUE(driver_->is_running()) << driver_->output();
  robot_.emplace(port());
  EXPECT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
}

TEST_F(CreateDriverProcess, AfterATripItGoesBackToItsMode) {
  const CommandSource source(key_, 0.2, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  robot_->trip();
  EXPECT_FALSE(drives());
  EXPECT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  EXPECT_EQ(robot_->mode(), OiMode::kSafe);
}

TEST_F(CreateDriverProcess, ASecondDriverDoesNotGetThePort) {
  const CommandSource source(key_, 0.2, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  ChildProcess second({program("create_driver"), "--url", kTestUrl, "--params",
                       (folder_.path() / "params.toml").string()},
                      folder_.path() / "second-output");
  EXPECT_TRUE(wait_until([&] {
    return second.output().find("in use by another process") != std::string::npos;
  })) << second.output();
  EXPECT_TRUE(drives());
}

TEST_F(CreateDriverProcess, StrangersMoveNothingAndAreCounted) {
  LcmBus bus(kTestUrl);
  create_state_t state{};
  bus.subscribe(channels::kCreateState, [&](const create_state_t& message) {
    state = message;
    if (message.refused_unsigned > 20 && message.refused_forged > 20) bus.stop();
  });
  SecretKey other_key = key_;
  other_key[0] ^= 1;
  std::int64_t sequence = 0;
  const auto give_up = Clock::now() + std::chrono::seconds(20);
  bus.every(milliseconds(10), [&](Time) {
    const bool is_forged = ++sequence % 2 == 0;
    auto command = drive_command(is_forged ? other_key : key_, wall_utime(), 9, sequence, 0.2, 0.0);
    if (!is_forged) command.signature.clear();
    command.signature_size = static_cast<std::int32_t>(command.signature.size());
    bus.publish(channels::kVelCmd, command);
    if (Clock::now() > give_up) bus.stop();
  });
  bus.run();
  EXPECT_GT(state.refused_unsigned, 20);
  EXPECT_GT(state.refused_forged, 20);
  EXPECT_EQ(state.driver_state, create_state_t::DRIVER_SILENT);
  EXPECT_FALSE(drives());
}

TEST_F(CreateDriverProcess, ASafetyServiceThatStartsAgainIsTakenUpWithItsNewKey) {
  {
    const CommandSource source(key_, 0.2, 0.0);
    ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  }
  ASSERT_TRUE(wait_until([&] { return !drives(); }));
  const SecretKey old_key = key_;
  key_ = make_key_file(folder_.path() / "key");
  const CommandSource source(key_, 0.2, 0.0);
  ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
  const CommandSource stale(old_key, 0.2, 1.0);
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_EQ(robot_->wheels(), (ScriptedRobot::Wheels{200, 200}));
}

TEST_F(CreateDriverProcess, ALogPlayedBesideTheRobotMovesNothing) {
  const std::string log = folder_.path() / "drive.lcmlog";
  {
    lcm::LogFile file(log, "w");
    std::vector<std::uint8_t> bytes;
    LcmBus bus(kTestUrl);
    bus.subscribe(channels::kVelCmd, [&](const velocity_command_t& command) {
      encode(command, bytes);
      lcm::LogEvent event{};
      event.timestamp = command.utime;
      event.channel = std::string(channels::kVelCmd.name);
      event.datalen = static_cast<std::int32_t>(bytes.size());
      event.data = bytes.data();
      file.writeEvent(&event);
    });
    const CommandSource source(key_, 0.2, 0.0);
    ASSERT_TRUE(wait_until([&] { return drives(); })) << driver_->output();
    bus.every(milliseconds(1000), [&](Time) { bus.stop(); });
    bus.run();
  }
  ASSERT_TRUE(wait_until([&] { return !drives(); }));
  const auto stopped = robot_->stopped_at();
  std::string said;
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(run_to_end({"lcm-logplayer", "--lcm-url", kTestUrl, log}, said), 0) << said;
  }
  EXPECT_EQ(robot_->stopped_at(), stopped);
  EXPECT_FALSE(drives());
}

TEST_F(CreateDriverProcess, ReplayIsRefusedInOneLine) {
  const std::string log = folder_.path() / "empty.lcmlog";
  std::ofstream(log).flush();
  std::string said;
  EXPECT_EQ(run_to_end({program("create_driver"), "--replay", log}, said), 1);
  EXPECT_NE(said.find("nothing to replay"), std::string::npos) << said;
}

}  // namespace
}  // namespace roomwise
