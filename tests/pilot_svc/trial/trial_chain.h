#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/robot_folder.h"

namespace roomwise {

/// What a trial is set up with.
struct TrialSetup {
  std::string url;
  std::string scenario = "living_room";  ///< of the simulator, or the text of one (with a newline)
  int seed = 1;
  std::string resolution = "320x240";
  std::vector<std::string> simulator;  ///< further options
  std::vector<std::string> pilot;
  /// Given the robot's port, the one create_driver is to open; not set: that one.
  std::function<std::string(const std::string&)> driver_port;
  std::filesystem::path log;  ///< all that is said, without the camera's frames; empty: no log
};

/// The simulator and every service of a robot as real processes on a bus of their own. To be used
/// inside a private network.
class TrialChain {
 public:
  explicit TrialChain(const TrialSetup& setup);
  TrialChain(const TrialChain&) = delete;
  TrialChain& operator=(const TrialChain&) = delete;
  ~TrialChain();

  const std::string& url() const { return setup_.url; }
  /// Names of those that have ended by themselves.
  std::string ended();
  std::string output() const;

 private:
  struct Part {
    std::string name;
    std::unique_ptr<ChildProcess> process;
  };
  void start(const std::string& name, const std::vector<std::string>& options);
  void start_logger();

  TrialSetup setup_;
  RobotFolder folder_;
  std::vector<Part> parts_;
};

}  // namespace roomwise
