#pragma once
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.h"

namespace roomwise {

/// The doors by which the processes of one simulated robot find each other, in a folder of its own.
class RobotFolder : public ScratchFolder {
 public:
  std::string create_port() const { return path() / "create"; }
  std::string key() const { return path() / "key"; }
  std::string kinect_door() const { return path() / "kinect"; }

  /// The simulator's options for its ends of them. `scenario`: its name, or the text of one (with
  /// a newline).
  std::vector<std::string> simulator_options(const std::string& scenario) const {
    return {"--scenario",  scenario_of(scenario), "--create_port",
            create_port(), "--kinect_door",       kinect_door()};
  }

 private:
  std::string scenario_of(const std::string& name_or_text) const {
    if (name_or_text.find('\n') == std::string::npos) return name_or_text;
    const std::string file = path() / "world.toml";
    std::ofstream(file) << name_or_text;
    return file;
  }
};

}  // namespace roomwise
