#include "tests/safety_svc/support/safety_chain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>

#include "tests/support/build_paths.h"

namespace roomwise {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

SafetyChain::SafetyChain(const ChainSetup& setup) : setup_(setup) {
  step_clock(std::chrono::seconds(0));
  start(kSimulator, std::vector<std::string>{program("simulator")} +
                        folder_.simulator_options(setup.scenario) + setup.simulator);
  start(kSafetySvc, std::vector<std::string>{program("safety_svc"), "--key_path", folder_.key()} +
                        setup.safety);
  start(kCreateDriver,
        {program("create_driver"), "--port", folder_.create_port(), "--key_path", folder_.key()});
  start(kSegmentSvc, {program("segment_svc")});
  // OpenNI2's drivers take no arguments: the door comes by the environment.
  start(kKinectPub, {"env", "ROOMWISE_SIM_KINECT=" + folder_.kinect_door(), program("kinect_pub"),
                     "--resolution", "320x240", "--use_color", "false", "--camera_height_m", "0.4",
                     "--camera_pitch_rad", "0.1"});
}

void SafetyChain::start(Part part, std::vector<std::string> command) {
  command.insert(command.begin(), {"env", "LD_PRELOAD=" + test_program("libtest_stepped_clock.so"),
                                   "ROOMWISE_TEST_CLOCK=" + (folder_.path() / "clock").string()});
  command.insert(command.end(), {"--url", setup_.url});
  processes_[part] =
      std::make_unique<ChildProcess>(command, folder_.path() / ("output-" + std::to_string(part)));
}

void SafetyChain::step_clock(std::chrono::seconds step) {
  clock_step_ += step;
  const std::int64_t nanoseconds = std::chrono::nanoseconds(clock_step_).count();
  const std::filesystem::path path = folder_.path() / "clock";
  // In place: the processes have mapped it.
  std::fstream file(path, std::filesystem::exists(path) ? std::ios::in | std::ios::out
                                                        : std::ios::out | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(&nanoseconds), sizeof nanoseconds);
}

/// A stamp by the processes' clock, which may just have been set, as this process's clock has it.
std::int64_t SafetyChain::unstepped(std::int64_t utime, Time now) const {
  const std::int64_t step_us = std::chrono::microseconds(clock_step_).count();
  const auto from_now = [&](std::int64_t t) { return std::abs(t - utime_of(now)); };
  return from_now(utime - step_us) < from_now(utime) ? utime - step_us : utime;
}

void SafetyChain::start_log() {
  logger_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{"lcm-logger", "--lcm-url=" + setup_.url, "--invert-channels",
                               "--channel=TRUTH", "--flush-interval=50", "--quiet",
                               folder_.path() / "log"},
      folder_.path() / "output-logger");
}

std::filesystem::path SafetyChain::end_log() {
  logger_->send_signal(SIGTERM);
  logger_->wait();
  logger_.reset();
  return folder_.path() / "log";
}

void SafetyChain::play(const std::filesystem::path& log) {
  player_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{"lcm-logplayer", "--lcm-url=" + setup_.url, log},
      folder_.path() / "output-player");
}

bool SafetyChain::listen_until(const std::function<bool()>& enough, double patience_s) {
  LcmBus bus(setup_.url);
  const auto keep = [&](auto& list, const auto& message) {
    list.push_back(message);
    list.back().utime = unstepped(message.utime, bus.now());
  };
  bus.subscribe(channels::kTruth, [&](const truth_t& m) { keep(truth, m); });
  bus.subscribe(channels::kCreateState, [&](const create_state_t& m) { keep(states, m); });
  bus.subscribe(channels::kSafetyState, [&](const safety_state_t& m) { keep(safety_states, m); });
  bus.subscribe(channels::kVelCmd, [this](const velocity_command_t& m) { commands.push_back(m); });
  const auto end = Clock::now() + milliseconds(std::lround(1000.0 * patience_s));
  bool is_enough = false;
  Clock::time_point last = Clock::now();
  bus.every(milliseconds(10), [&](Time) {
    const Clock::time_point now = Clock::now();
    longest_stall_s_ =
        std::max(longest_stall_s_, std::chrono::duration<double>(now - last).count());
    last = now;
    if (asks && ++turns_ % 5 == 0) ask(bus);
    if (also) also(bus);
    is_enough = enough();
    if (is_enough || now > end) bus.stop();
  });
  bus.run();
  return is_enough;
}

void SafetyChain::ask(LcmBus& bus) {
  velocity_request_t request{};
  request.utime = utime_of(bus.now() + clock_step_);
  request.source = "test";
  request.priority = velocity_request_t::PRIORITY_PERSON;
  request.valid_for_us = 150'000;
  request.requested_speed_mps = setup_.speed_mps;
  request.requested_turn_rate_radps = setup_.turn_rate_radps;
  bus.publish(channels::kVelRequest, request);
}

double SafetyChain::true_speed_mps() const {
  constexpr std::size_t kBack = 3;
  if (truth.size() <= kBack) return 0.0;
  const truth_t& a = truth[truth.size() - 1 - kBack];
  const truth_t& b = truth.back();
  const double dt_s = 1e-6 * static_cast<double>(b.utime - a.utime);
  return std::hypot(b.true_x_m - a.true_x_m, b.true_y_m - a.true_y_m) / dt_s;
}

std::string SafetyChain::output() const {
  std::string all;
  for (const auto& process : processes_) all += process->output();
  if (logger_) all += logger_->output();
  if (player_) all += player_->output();
  if (!safety_states.empty()) all += "safety_svc: " + safety_states.back().reason_text + "\n";
  return all;
}

}  // namespace roomwise
