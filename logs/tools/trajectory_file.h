#pragma once
#include <filesystem>
#include <string>

#include "logs/tools/trajectory.h"

namespace roomwise {

/// A trajectory in the plane as TUM text: "time tx ty tz qx qy qz qw" a line, seconds and metres,
/// # comments. Times keep their microseconds, places and directions nine decimals.
std::string trajectory_as_tum_text(const Trajectory& trajectory);

/// Reads such a file; tz, and any turn but about z, are left aside. Throws std::runtime_error
/// naming the file and line at fault.
Trajectory read_tum_trajectory(const std::filesystem::path& path);

}  // namespace roomwise
