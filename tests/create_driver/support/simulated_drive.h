#pragma once
#include <map>
#include <string>
#include <vector>

#include "common/channels.h"

namespace roomwise {

/// What a run of the real simulator and the real create_driver came to.
struct SimulatedDrive {
  std::vector<create_state_t> states;
  std::vector<odometry_t> odometry;
  std::vector<truth_t> truth;
  std::map<std::string, std::int64_t> counters;  ///< of create_driver, from its last HEALTH
  std::string output;                            ///< what create_driver said

  create_state_t last_state() const;
  std::int64_t count(const std::string& name) const;
  /// Whether every state of the last half second says so.
  bool ends_driving() const;
  /// How far the robot really went in the last half second.
  double ends_moving_m() const;
  /// Whether any state satisfies `condition`.
  template <class Condition>
  bool ever(Condition condition) const {
    for (const create_state_t& state : states) {
      if (condition(state)) return true;
    }
    return false;
  }
};

/// How to run one: VEL_CMD asks for the same all the time.
struct DriveSetup {
  std::string url;
  std::vector<std::string> simulator_arguments;
  std::string driver_params;
  double speed_mps = 0.1;
  double turn_rate_radps = 0.8;
  double time_s = 6.0;       ///< at least
  double patience_s = 20.0;  ///< so much longer, until the robot has driven for half a second
};

/// Runs simulator (scenario "empty") and create_driver on it for a while.
SimulatedDrive drive_in_simulator(const DriveSetup& setup);

}  // namespace roomwise
