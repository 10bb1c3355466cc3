#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "services/simulator/simulator_params.h"

namespace roomwise::simulator {

/// A drive that is recorded and not lived.
struct DriveOrder {
  std::string path = "loop1";  ///< one of the scenario's
  double seconds = 0.0;        ///< ends after that; 0: with the path
};

/// What came of it.
struct DriveSummary {
  std::int64_t frames = 0;
  double driven_s = 0.0;
  bool arrived = false;  ///< the path was driven to its end
};

/// Drives the path in the scenario, with no clock and no hardware, and writes what a live system
/// would have recorded: KINECT_FRAME at 30 Hz, CREATE_STATE and ODOMETRY as the robot's stream has
/// them, TRUTH at 60 Hz. The same request and parameters give the same bytes. Throws
/// std::runtime_error naming the scenario, path or file at fault; no log is left then.
DriveSummary record_drive(const SimulatorParams& params, const DriveOrder& request,
                          const std::filesystem::path& log_path);

}  // namespace roomwise::simulator
