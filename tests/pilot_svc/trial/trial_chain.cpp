#include "tests/pilot_svc/trial/trial_chain.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>

#include "tests/support/build_paths.h"

namespace roomwise {
namespace {

constexpr const char* kLogger = "lcm-logger";

}  // namespace

TrialChain::TrialChain(const TrialSetup& setup) : setup_(setup) {
  // OpenNI2's drivers take no arguments: the door comes by the environment.
  ::setenv("ROOMWISE_SIM_KINECT", folder_.kinect_door().c_str(), 1);
  if (!setup.log.empty()) start_logger();
  std::vector<std::string> world = folder_.simulator_options(setup.scenario);
  world.insert(world.end(), {"--seed", std::to_string(setup.seed)});
  world.insert(world.end(), setup.simulator.begin(), setup.simulator.end());
  start("simulator", world);
  start("safety_svc", {"--key_path", folder_.key()});
  const std::string robot = folder_.create_port();
  const std::string port = setup.driver_port ? setup.driver_port(robot) : robot;
  start("create_driver", {"--port", port, "--key_path", folder_.key()});
  start("landmark_svc", {});
  start("segment_svc", {});
  start("ekf_svc", {});
  start("pilot_svc", setup.pilot);
  start("kinect_pub", {"--resolution", setup.resolution, "--camera_height_m", "0.4",
                       "--camera_pitch_rad", "0.1"});
}

/// Killed, the logger would leave half an event at the log's end.
TrialChain::~TrialChain() {
  for (const Part& part : parts_) {
    if (part.name != kLogger) continue;
    part.process->send_signal(SIGTERM);
    try {
      part.process->wait(std::chrono::seconds(20));
    } catch (const std::exception&) {  // then it is killed after all
    }
  }
}

void TrialChain::start(const std::string& name, const std::vector<std::string>& options) {
  std::vector<std::string> command{program(name), "--url", setup_.url};
  command.insert(command.end(), options.begin(), options.end());
  parts_.push_back({name, std::make_unique<ChildProcess>(command, folder_.path() / name)});
}

void TrialChain::start_logger() {
  const std::vector<std::string> command = {kLogger,
                                            "--lcm-url=" + setup_.url,
                                            "--invert-channels",
                                            "--channel=KINECT_FRAME",
                                            "--force",
                                            "--quiet",
                                            setup_.log.string()};
  parts_.push_back({kLogger, std::make_unique<ChildProcess>(command, folder_.path() / "log")});
}

std::string TrialChain::ended() {
  std::string names;
  for (const Part& part : parts_) {
    if (!part.process->is_running()) names += " " + part.name;
  }
  return names;
}

std::string TrialChain::output() const {
  std::string all;
  for (const Part& part : parts_) all += part.process->output();
  return all;
}

}  // namespace roomwise
