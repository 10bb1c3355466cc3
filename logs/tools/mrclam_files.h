#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace roomwise {

/// The text files of a UTIAS MRCLAM folder, as they are, in order of time.
struct MrclamVelocity {
  std::int64_t utime;
  double speed_mps;
  double turn_rate_radps;
};

struct MrclamMeasurement {
  std::int64_t utime;
  int barcode;
  double range_m;
  double bearing_rad;
};

struct MrclamPose {
  std::int64_t utime;
  double x_m;
  double y_m;
  double heading_rad;
};

struct MrclamPoint {
  double x_m;
  double y_m;
};

struct MrclamFiles {
  std::vector<MrclamVelocity> velocities;
  std::vector<MrclamMeasurement> measurements;
  std::vector<MrclamPose> truth;
  std::map<int, int> subject_of_barcode;
  std::map<int, MrclamPoint> landmarks;  ///< by subject
};

/// Throws std::runtime_error naming the file and line at fault.
MrclamFiles read_mrclam(const std::filesystem::path& folder, int robot);

}  // namespace roomwise
