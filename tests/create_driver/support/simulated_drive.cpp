#include "tests/create_driver/support/simulated_drive.h"

#include <cmath>
#include <csignal>
#include <fstream>

#include "common/bus/lcm_bus.h"
#include "tests/support/child_process.h"
#include "tests/support/drive_command.h"
#include "tests/support/robot_folder.h"
#include "tests/system/live_service.h"

namespace roomwise {
namespace {

constexpr std::int64_t kLastPart_us = 500'000;

/// Asks create_driver for one motion and keeps all that is said meanwhile.
class Listener {
 public:
  Listener(const DriveSetup& setup, const SecretKey& key, SimulatedDrive& drive)
      : setup_(setup), key_(key), drive_(drive), bus_(setup.url) {
    keep(channels::kCreateState, drive.states);
    keep(channels::kOdometry, drive.odometry);
    keep(channels::kTruth, drive.truth);
    bus_.subscribe(channels::kHealth, [this](const health_t& health) { note(health); });
    bus_.every(std::chrono::milliseconds(20), [this](Time) { command(); });
  }

  void listen() {
    end_ = utime_of(bus_.now()) + std::llround(setup_.time_s * 1e6);
    bus_.run();
  }

 private:
  template <class Message>
  void keep(const Channel<Message>& channel, std::vector<Message>& into) {
    bus_.subscribe(channel, [&into](const Message& message) { into.push_back(message); });
  }

  void note(const health_t& health) {
    if (health.service != "create_driver") return;
    for (const named_count_t& counter : health.counters) {
      drive_.counters[counter.name] = counter.count;
    }
  }

  void command() {
    auto command = drive_command(key_, utime_of(bus_.now()), 1, ++sequence_, setup_.speed_mps,
                                 setup_.turn_rate_radps);
    bus_.publish(channels::kVelCmd, command);
    if (command.utime > end_ && (drive_.ends_driving() || patience_is_over(command.utime))) {
      bus_.stop();
    }
  }

  bool patience_is_over(std::int64_t utime) const {
    return utime > end_ + std::llround(setup_.patience_s * 1e6);
  }

  const DriveSetup& setup_;
  SecretKey key_;
  SimulatedDrive& drive_;
  LcmBus bus_;
  std::int64_t sequence_ = 0;
  std::int64_t end_ = 0;
};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

create_state_t SimulatedDrive::last_state() const {
  return states.empty() ? create_state_t{} : states.back();
}

std::int64_t SimulatedDrive::count(const std::string& name) const {
  const auto found = counters.find(name);
  return found == counters.end() ? 0 : found->second;
}

bool SimulatedDrive::ends_driving() const {
  if (states.empty()) return false;
  for (const create_state_t& state : states) {
    const bool is_late = state.utime > states.back().utime - kLastPart_us;
    if (is_late && state.driver_state != create_state_t::DRIVER_DRIVING) return false;
  }
  return true;
}

double SimulatedDrive::ends_moving_m() const {
  double moved_m = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    if (truth[i].utime < truth.back().utime - kLastPart_us) continue;
    moved_m += std::hypot(truth[i].true_x_m - truth[i - 1].true_x_m,
                          truth[i].true_y_m - truth[i - 1].true_y_m);
  }
  return moved_m;
}

SimulatedDrive drive_in_simulator(const DriveSetup& setup) {
  const RobotFolder folder;
  const SecretKey key = make_key_file(folder.key());
  const std::string params = folder.path() / "params.toml";
  std::ofstream(params) << "port = \"" << folder.create_port() << "\"\nkey_path = \""
                        << folder.key() << "\"\n"
                        << setup.driver_params;
  SimulatedDrive drive;
  ChildProcess simulator(std::vector<std::string>{program("simulator"), "--url", setup.url} +
                             folder.simulator_options("empty") + setup.simulator_arguments,
                         folder.path() / "simulator-output");
  ChildProcess driver({program("create_driver"), "--url", setup.url, "--params", params},
                      folder.path() / "driver-output");
  Listener(setup, key, drive).listen();
  driver.send_signal(SIGTERM);
  driver.wait();
  drive.output = driver.output() + simulator.output();
  return drive;
}

}  // namespace roomwise
