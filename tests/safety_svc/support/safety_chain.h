#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/lcm_bus.h"
#include "common/channels.h"
#include "tests/support/child_process.h"
#include "tests/support/robot_folder.h"

namespace roomwise {

/// How one drive is set up.
struct ChainSetup {
  std::string url;
  std::string scenario = "empty";      ///< of the simulator, or the text of one (with a newline)
  std::vector<std::string> simulator;  ///< further options
  std::vector<std::string> safety;
  double speed_mps = 0.3;  ///< what is asked for, at 20 Hz
  double turn_rate_radps = 0.0;
};

/// simulator, kinect_pub, segment_svc, create_driver and safety_svc as real processes on a bus of
/// their own, somebody who asks for one motion, and all that is said meanwhile. To be used inside a
/// private network.
class SafetyChain {
 public:
  enum Part { kSimulator, kKinectPub, kSegmentSvc, kCreateDriver, kSafetySvc };
  static constexpr int kParts = 5;

  explicit SafetyChain(const ChainSetup& setup);

  void send_signal(Part part, int signal) const { processes_[part]->send_signal(signal); }

  /// Listens until `enough` says so, looked at every 10 ms, or `patience_s` went by. Whether it
  /// did.
  bool listen_until(const std::function<bool()>& enough, double patience_s);
  void listen_for(double time_s) {
    listen_until([] { return false; }, time_s);
  }

  /// Sets the wall clock of all processes forward by that much.
  void step_clock(std::chrono::seconds step);
  /// Begins to write down all that is said but TRUTH, which no robot has.
  void start_log();
  /// Ends that. Where it is; in a folder that goes when this object does.
  std::filesystem::path end_log();
  /// Plays a log on the chain's bus, with stock lcm-logplayer.
  void play(const std::filesystem::path& log);

  bool asks = true;
  std::function<void(LcmBus&)> also;  ///< called every 10 ms

  std::vector<truth_t> truth;
  std::vector<create_state_t> states;
  std::vector<safety_state_t> safety_states;
  std::vector<velocity_command_t> commands;

  /// How fast the robot really moves [m/s].
  double true_speed_mps() const;

  /// The longest this listener, which asks to be called every 10 ms, was left waiting since
  /// forget_stalls(): how much of its time the machine gave to others [s].
  double longest_stall_s() const { return longest_stall_s_; }
  void forget_stalls() { longest_stall_s_ = 0.0; }
  std::filesystem::path folder() const { return folder_.path(); }
  std::string output() const;

 private:
  void start(Part part, std::vector<std::string> command);
  void ask(LcmBus& bus);
  std::int64_t unstepped(std::int64_t utime, Time now) const;

  ChainSetup setup_;
  RobotFolder folder_;
  std::unique_ptr<ChildProcess> processes_[kParts];
  std::unique_ptr<ChildProcess> logger_;
  std::unique_ptr<ChildProcess> player_;
  std::chrono::seconds clock_step_{0};
  int turns_ = 0;
  double longest_stall_s_ = 0.0;
};

}  // namespace roomwise
