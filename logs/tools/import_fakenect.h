#pragma once
#include <filesystem>
#include <iosfwd>

namespace roomwise {

struct FakenectImport {
  std::filesystem::path folder{};
  std::filesystem::path out{};
  double camera_height_m = 0.4;
};

/// Makes a log of a folder that libfreenect's `fakenect-record` wrote of a Kinect v1: INDEX.txt
/// names d-TIME-TICKS.pgm (11-bit disparity words, little-endian whatever PGM says) and, where
/// colour was recorded, r-TIME-TICKS.ppm.
///
/// Words become millimetres by the device's nominal geometry; a depth image goes with the colour
/// image nearest in time, at most 20 ms away, or with none. KINECT_FRAME.utime is the TIME of the
/// depth image, device_time_us its TICKS of a 60 MHz clock. Says on `notes` what it assumed. The
/// same folder gives the same bytes.
///
/// Throws std::runtime_error naming the file at fault; `out` then stays as it was.
void import_fakenect(const FakenectImport& import, std::ostream& notes);

}  // namespace roomwise
