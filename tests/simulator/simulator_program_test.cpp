// The whole program: a real process, a real pseudo-terminal, real LCM in a private network.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "common/bus/lcm_bus.h"
#include "tests/simulator/support/host_port.h"
#include "tests/support/build_paths.h"
#include "tests/support/child_process.h"
#include "tests/support/private_network.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

using Bytes = std::vector<std::uint8_t>;
using namespace std::chrono_literals;

constexpr const char* kUrl = "udpm://239.255.76.67:27667?ttl=0&recv_buf_size=212992";

enum class Sum { kRight, kAny };

/// Frames of a stream of packet 7 alone: 19 2 7 x sum.
std::size_t count_frames(const Bytes& bytes, Sum wanted = Sum::kRight) {
  std::size_t found = 0;
  for (std::size_t i = 0; i + 5 <= bytes.size(); ++i) {
    const int sum = bytes[i] + bytes[i + 1] + bytes[i + 2] + bytes[i + 3] + bytes[i + 4];
    const bool is_frame = bytes[i] == 19 && bytes[i + 1] == 2 && bytes[i + 2] == 7;
    if (is_frame && (wanted == Sum::kAny || sum % 256 == 0)) ++found;
  }
  return found;
}

auto frames(std::size_t wanted) {
  return [wanted](const Bytes& bytes) { return count_frames(bytes) >= wanted; };
}

class SimulatorProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {
        program("simulator"), "--url", kUrl, "--scenario", "empty", "--create_port", port.string()};
    command.insert(command.end(), more.begin(), more.end());
    process = std::make_unique<ChildProcess>(command, folder.path() / "output");
    for (int i = 0; i < 1000 && !std::filesystem::exists(port) && process->is_running(); ++i) {
      std::this_thread::sleep_for(10ms);
    }
    ASSERT_TRUE(std::filesystem::exists(port)) << process->output();
  }
  /// The empty world with more in it, above.
  void write_scenario(const std::string& more) const {
    std::ifstream empty(source_folder().string() + "/services/simulator/scenarios/empty.toml");
    std::ofstream(scenario) << more << empty.rdbuf();
  }
  int stop(int signal = SIGINT) {
    process->send_signal(signal);
    return process->wait();
  }
  int run_to_failure(const std::vector<std::string>& more, std::string& said) {
    std::vector<std::string> command = {program("simulator"), "--url", kUrl, "--create_port",
                                        port.string()};
    command.insert(command.end(), more.begin(), more.end());
    return run_to_end(command, said);
  }

  /// TRUTH messages until `enough(all of them)`, half a minute at most.
  std::vector<truth_t> listen(const std::function<bool(const std::vector<truth_t>&)>& enough) {
    LcmBus bus(kUrl);
    std::vector<truth_t> heard;
    bus.subscribe(channels::kTruth, [&](const truth_t& truth) {
      heard.push_back(truth);
      if (enough(heard)) bus.stop();
    });
    const Time end = bus.now() + std::chrono::seconds(30);
    bus.every(100ms, [&](Time now) {
      if (now > end) bus.stop();
    });
    bus.run();
    return heard;
  }

  ScratchFolder folder;
  std::filesystem::path port = folder.path() / "create";
  std::filesystem::path scenario = folder.path() / "own.toml";
  std::unique_ptr<ChildProcess> process;
};

TEST_F(SimulatorProgram, StreamsToAHostAndStopsCleanly) {
  start();
  const HostPort host(port);
  ASSERT_TRUE(host.write({128, 148, 1, 7}));
  EXPECT_GE(count_frames(host.read_until(frames(60))), 60U);
  EXPECT_EQ(stop(), 0) << process->output();
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(port)));
}

TEST_F(SimulatorProgram, TruthFollowsTheRobot) {
  start();
  const HostPort host(port);
  ASSERT_TRUE(host.write({128, 131, 145, 0, 200, 0, 200}));
  const auto truth = listen([](const auto& heard) { return heard.back().true_x_m > 0.5; });
  ASSERT_GT(truth.size(), 60U);
  EXPECT_GT(truth.back().true_x_m, 0.5);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(truth[i].utime - truth[i - 1].utime), 16'667.0, 1'000.0);
    EXPECT_LE(std::abs(truth[i].true_x_m - truth[i - 1].true_x_m), 0.2 * 0.018);
    EXPECT_EQ(truth[i].has_camera_pose, 1);
  }
}

TEST_F(SimulatorProgram, LandmarksOfTheSceneComeOnceASecond) {
  start({"--scenario", "living_room"});
  const auto truth = listen([](const auto& heard) { return heard.size() >= 130; });
  const auto with = std::count_if(truth.begin(), truth.end(),
                                  [](const truth_t& t) { return t.landmark_count > 0; });
  EXPECT_GE(with, 2);
  EXPECT_LE(with, 3);
}

TEST_F(SimulatorProgram, WrongBaudIsGarbageUntilItIsRight) {
  start();
  const HostPort host(port, B57600);
  host.write({128, 148, 1, 7});
  EXPECT_EQ(count_frames(host.read_until(frames(1), 500ms)), 0U) << "not even understood";
  host.set_speed(B115200);
  std::this_thread::sleep_for(50ms);
  host.write({128, 148, 1, 7});
  EXPECT_GE(count_frames(host.read_until(frames(5))), 5U);
  host.set_speed(B19200);
  std::this_thread::sleep_for(50ms);
  host.read();
  const Bytes garbage = host.read_until([](const Bytes& bytes) { return bytes.size() > 50; });
  EXPECT_GT(garbage.size(), 50U);
  EXPECT_EQ(count_frames(garbage), 0U);
}

TEST_F(SimulatorProgram, DrivesOnForEverWhenItsHostDies) {
  start();
  {
    const HostPort host(port);
    ASSERT_TRUE(host.write({128, 132, 145, 0, 100, 0, 100}));
    std::this_thread::sleep_for(50ms);
  }
  const auto truth = listen([](const auto& heard) { return heard.back().true_x_m > 0.15; });
  EXPECT_GT(truth.back().true_x_m, 0.15);
}

TEST_F(SimulatorProgram, ComesBackAfterItsCableWasPulled) {
  start({"--fault", "at_s=1,kind=hang_up,for_s=0.3"});
  {
    const HostPort host(port);
    ASSERT_TRUE(host.write({128, 131, 148, 1, 7}));
    host.read_until([](const Bytes&) { return false; });
    EXPECT_TRUE(host.has_hung_up());
  }
  while (process->is_running() && !std::filesystem::exists(port)) std::this_thread::sleep_for(10ms);
  const HostPort again(port);
  EXPECT_GE(count_frames(again.read_until(frames(5))), 5U) << "the robot streams on";
}

TEST_F(SimulatorProgram, AKilledOneLeavesAPortItsSuccessorTakesOver) {
  start();
  stop(SIGKILL);
  EXPECT_TRUE(std::filesystem::is_symlink(std::filesystem::symlink_status(port)));
  start();
  const HostPort host(port);
  ASSERT_TRUE(host.write({128, 148, 1, 7}));
  EXPECT_GE(count_frames(host.read_until(frames(5))), 5U);
}

TEST_F(SimulatorProgram, LivesThroughWhatItMissedWhileStopped) {
  start();
  const HostPort host(port);
  ASSERT_TRUE(host.write({128, 132, 145, 0, 200, 0, 200}));
  std::this_thread::sleep_for(300ms);
  process->send_signal(SIGSTOP);
  std::this_thread::sleep_for(700ms);
  process->send_signal(SIGCONT);
  const auto truth = listen([](const auto& heard) { return heard.back().true_x_m > 0.3; });
  ASSERT_GT(truth.size(), 30U);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    EXPECT_EQ(truth[i].seq, truth[i - 1].seq + 1);
    EXPECT_NEAR(static_cast<double>(truth[i].utime - truth[i - 1].utime), 16'667.0, 1'000.0);
  }
}

TEST_F(SimulatorProgram, FaultsOfTheCommandLineAllHappen) {
  start({"--fault", "at_s=1.2,kind=reboot", "--fault", "at_s=0.9,kind=byte_flip,count=3,byte=3"});
  const HostPort host(port);
  ASSERT_TRUE(host.write({128, 148, 1, 7}));
  const auto has_banner = [](const Bytes& bytes) {
    return std::string(bytes.begin(), bytes.end()).find("CLEAN\r\n") != std::string::npos;
  };
  const Bytes stream = host.read_until(has_banner);
  EXPECT_TRUE(has_banner(stream));
  EXPECT_EQ(count_frames(stream, Sum::kAny) - count_frames(stream), 3U);
}

TEST_F(SimulatorProgram, FaultsOfTheScenarioHappen) {
  write_scenario("[[fault]]\nname = 'bump'\nat_s = 0.5\nfor_s = 60\n");
  start({"--scenario", scenario.string()});
  const HostPort host(port);
  ASSERT_TRUE(host.write({128, 148, 1, 7}));
  const auto bumped = [](const Bytes& bytes) {
    const Bytes frame = {19, 2, 7, 3, 225};
    return std::search(bytes.begin(), bytes.end(), frame.begin(), frame.end()) != bytes.end();
  };
  EXPECT_TRUE(bumped(host.read_until(bumped)));
}

TEST_F(SimulatorProgram, SaysWhatItCannotStartWith) {
  std::string said;
  write_scenario("[[fault]]\nname = 'melt'\nat_s = 0.5\n");
  EXPECT_EQ(run_to_failure({"--scenario", scenario.string()}, said), 1);
  EXPECT_NE(said.find("own.toml:1: fault"), std::string::npos) << said;
  EXPECT_EQ(run_to_failure({"--scenario", "nowhere"}, said), 1);
  EXPECT_NE(said.find("nowhere"), std::string::npos) << said;
  EXPECT_EQ(run_to_failure({"--fault", "at_s=1,kind=melt"}, said), 1);
  EXPECT_NE(said.find("\"at_s=1,kind=melt\""), std::string::npos) << said;
  EXPECT_EQ(run_to_failure({"--create_port", "/proc/nobody/create"}, said), 1);
  EXPECT_NE(said.find("/proc/nobody/create"), std::string::npos) << said;
}

}  // namespace
}  // namespace roomwise::simulator
