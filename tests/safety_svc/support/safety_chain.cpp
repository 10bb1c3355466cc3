#include "tests/safety_svc/support/safety_chain.h"

#include <algorithm>
#include <chrono>
#include <cmath>

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
  command.insert(command.end(), {"--url", setup_.url});
  processes_[part] =
      std::make_unique<ChildProcess>(command, folder_.path() / ("output-" + std::to_string(part)));
}

bool SafetyChain::listen_until(const std::function<bool()>& enough, double patience_s) {
  LcmBus bus(setup_.url);
  bus.subscribe(channels::kTruth, [this](const truth_t& m) { truth.push_back(m); });
  bus.subscribe(channels::kCreateState, [this](const create_state_t& m) { states.push_back(m); });
  bus.subscribe(channels::kSafetyState,
                [this](const safety_state_t& m) { safety_states.push_back(m); });
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
  request.utime = utime_of(bus.now());
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
  if (!safety_states.empty()) all += "safety_svc: " + safety_states.back().reason_text + "\n";
  return all;
}

}  // namespace roomwise
