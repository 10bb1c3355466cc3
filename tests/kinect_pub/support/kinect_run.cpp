#include "tests/kinect_pub/support/kinect_run.h"

#include <csignal>
#include <cstdlib>
#include <fstream>

#include "tests/support/build_paths.h"

namespace roomwise {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:27668?ttl=0&recv_buf_size=212992";

}  // namespace

KinectRun::KinectRun() { ::setenv("ROOMWISE_SIM_KINECT", door_.c_str(), 1); }

void KinectRun::start_camera() {
  camera_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{test_program("made_camera"), door_.string()},
      folder_.path() / "camera-said");
}

void KinectRun::kill_camera() {
  camera_->send_signal(SIGKILL);
  camera_->wait();
}

void KinectRun::start_kinect_pub(const std::string& params, const Environment& environment) {
  const std::filesystem::path file = folder_.path() / "params.toml";
  std::ofstream(file) << "# as the test wants it\n" << params;
  std::vector<std::string> command = {"env"};
  command.insert(command.end(), environment.begin(), environment.end());
  command.insert(command.end(), {program("kinect_pub"), "--url", kUrl, "--params", file.string()});
  kinect_pub_ = std::make_unique<ChildProcess>(command, folder_.path() / "kinect_pub-said");
}

void KinectRun::run_bus() {
  bus_ = std::make_unique<LcmBus>(kUrl);
  bus_->subscribe(channels::kKinectFrame, [this](const kinect_frame_t& frame) {
    if (on_frame_) on_frame_(frame);
  });
  bus_->subscribe(channels::kKinectStatus, [this](const device_status_t& status) {
    if (on_status_) on_status_(status);
  });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  bus_->every(std::chrono::milliseconds(100), [&](Time) {
    if (std::chrono::steady_clock::now() > deadline || !kinect_pub_->is_running()) bus_->stop();
  });
  bus_->run();
  on_frame_ = {};
  on_status_ = {};
}

std::vector<kinect_frame_t> KinectRun::frames(std::size_t count) {
  std::vector<kinect_frame_t> seen;
  on_frame_ = [&](const kinect_frame_t& frame) {
    seen.push_back(frame);
    if (seen.size() == count) bus_->stop();
  };
  run_bus();
  return seen;
}

std::optional<device_status_t> KinectRun::status(
    const std::function<bool(const device_status_t&)>& enough) {
  std::optional<device_status_t> seen;
  on_status_ = [&](const device_status_t& status) {
    if (seen || !enough(status)) return;
    seen = status;
    bus_->stop();
  };
  run_bus();
  return seen;
}

std::optional<device_status_t> KinectRun::status_of_state(std::int8_t state) {
  return status([state](const device_status_t& status) { return status.state == state; });
}

}  // namespace roomwise
