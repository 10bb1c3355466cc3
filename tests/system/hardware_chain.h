#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/auth/secret_key.h"
#include "common/bus/lcm_bus.h"
#include "common/channels.h"
#include "tests/support/child_process.h"
#include "tests/support/robot_folder.h"

namespace roomwise {

/// simulator, create_driver and kinect_pub as real processes, and what they publish. To be used
/// inside a private network.
class HardwareChain {
 public:
  enum Part { kSimulator, kCreateDriver, kKinectPub };
  static constexpr int kParts = 3;

  /// `scenario` of the simulator; further options of kinect_pub.
  explicit HardwareChain(std::string scenario, std::vector<std::string> kinect_options = {});

  void start(Part part);
  void start_all();
  void kill(Part part);

  /// Listens, asking create_driver for a slow circle all the while, until `enough` says so, for
  /// half a minute at most. Whether it did.
  bool listen_until(const std::function<bool()>& enough);
  void listen_for(std::chrono::milliseconds time);

  /// What came since the last call of `forget`.
  std::vector<kinect_frame_t> frames;
  std::vector<create_state_t> states;
  std::vector<truth_t> truth;
  void forget();

  /// Where the simulated camera's frames come out.
  std::filesystem::path door() const { return folder_.kinect_door(); }
  /// All that the processes running now have said.
  std::string output() const;

 private:
  void command(LcmBus& bus);

  RobotFolder folder_;
  SecretKey key_ = make_key_file(folder_.key());
  std::string scenario_;
  std::vector<std::string> kinect_options_;
  std::int64_t sequence_ = 0;
  std::unique_ptr<ChildProcess> processes_[kParts];
};

}  // namespace roomwise
