#include "tests/system/hardware_chain.h"

#include <csignal>
#include <cstdlib>

#include "tests/support/build_paths.h"
#include "tests/support/drive_command.h"
#include "tests/system/live_service.h"

namespace roomwise {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::seconds(30);

}  // namespace

HardwareChain::HardwareChain(std::string scenario, std::vector<std::string> kinect_options)
    : scenario_(std::move(scenario)), kinect_options_(std::move(kinect_options)) {
  ::setenv("ROOMWISE_SIM_KINECT", door().c_str(), 1);  // OpenNI2's drivers take no arguments
}

void HardwareChain::start(Part part) {
  std::vector<std::string> command;
  switch (part) {
    case kSimulator:
      command = folder_.simulator_options(scenario_);
      command.insert(command.begin(), program("simulator"));
      break;
    case kCreateDriver:
      command = {program("create_driver"), "--port", folder_.create_port(), "--key_path",
                 folder_.key()};
      break;
    case kKinectPub:
      command = {program("kinect_pub")};
      command.insert(command.end(), kinect_options_.begin(), kinect_options_.end());
      break;
  }
  command.insert(command.end(), {"--url", kTestUrl});
  const std::string output = folder_.path() / ("output-" + std::to_string(part));
  processes_[part].reset();
  processes_[part] = std::make_unique<ChildProcess>(command, output);
}

void HardwareChain::start_all() {
  for (const Part part : {kSimulator, kCreateDriver, kKinectPub}) start(part);
}

void HardwareChain::kill(Part part) {
  processes_[part]->send_signal(SIGKILL);
  processes_[part]->wait();
}

bool HardwareChain::listen_until(const std::function<bool()>& enough) {
  LcmBus bus(kTestUrl);
  bus.subscribe(channels::kKinectFrame, [this](const kinect_frame_t& f) { frames.push_back(f); });
  bus.subscribe(channels::kCreateState, [this](const create_state_t& s) { states.push_back(s); });
  bus.subscribe(channels::kTruth, [this](const truth_t& t) { truth.push_back(t); });
  const auto end = Clock::now() + kPatience;
  bool is_enough = false;
  bus.every(std::chrono::milliseconds(20), [&](Time) {
    command(bus);
    is_enough = enough();
    if (is_enough || Clock::now() > end) bus.stop();
  });
  bus.run();
  return is_enough;
}

void HardwareChain::listen_for(std::chrono::milliseconds time) {
  const auto end = Clock::now() + time;
  listen_until([end] { return Clock::now() > end; });
}

void HardwareChain::forget() {
  frames.clear();
  states.clear();
  truth.clear();
}

std::string HardwareChain::output() const {
  std::string all;
  for (const auto& process : processes_) {
    if (process) all += process->output();
  }
  return all;
}

void HardwareChain::command(LcmBus& bus) {
  auto command = drive_command(key_, utime_of(bus.now()), 1, ++sequence_, 0.1, 0.5);
  bus.publish(channels::kVelCmd, command);
}

}  // namespace roomwise
