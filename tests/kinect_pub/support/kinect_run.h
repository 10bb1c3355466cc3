#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/lcm_bus.h"
#include "tests/support/child_process.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {

/// kinect_pub and a camera as real processes on a bus of their own, with what they publish. To be
/// used inside a private network.
class KinectRun {
 public:
  using Environment = std::vector<std::string>;  ///< NAME=VALUE

  KinectRun();

  void start_camera();
  void kill_camera();
  /// `params`: lines of its parameter file.
  void start_kinect_pub(const std::string& params, const Environment& environment = {});
  ChildProcess& kinect_pub() { return *kinect_pub_; }

  /// The next `count` frames; fewer if half a minute goes by.
  std::vector<kinect_frame_t> frames(std::size_t count);

  /// The first KINECT_STATUS that `enough` accepts; nothing if none comes within half a minute.
  std::optional<device_status_t> status(const std::function<bool(const device_status_t&)>& enough);
  std::optional<device_status_t> status_of_state(std::int8_t state);

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::string camera_uri() const { return "roomwise-sim://" + door_.string(); }

 private:
  /// Runs the bus until stopped or for half a minute.
  void run_bus();

  ScratchFolder folder_;
  std::filesystem::path door_ = folder_.path() / "kinect";
  std::unique_ptr<LcmBus> bus_;
  std::function<void(const kinect_frame_t&)> on_frame_;
  std::function<void(const device_status_t&)> on_status_;
  std::unique_ptr<ChildProcess> camera_;
  std::unique_ptr<ChildProcess> kinect_pub_;
};

}  // namespace roomwise
