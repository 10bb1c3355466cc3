#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iosfwd>

namespace roomwise {

struct OniImport {
  std::filesystem::path recording{};
  std::filesystem::path out{};
  double camera_height_m = 0.4;
  bool registered = false;  ///< a recording does not say whether its depth lies on its colour
};

/// Makes a log of an OpenNI2 recording (.oni): each depth image with the colour image nearest in
/// time, at most half a frame away; depth images without one are left out and counted where the
/// recording has colour at all. KINECT_FRAME.device_time_us is the depth image's time by the
/// camera's clock; utime runs as that does from a fixed day on, for a recording does not say when
/// it was made: where the camera's clock starts anew or leaps by more than an hour the next frame
/// comes 1/30 s later. Readings beyond 10 m are none. Says on `notes` what it assumed. The same
/// recording gives the same bytes.
///
/// Throws std::runtime_error naming the file at fault; `out` then stays as it was.
void import_oni(const OniImport& import, std::ostream& notes);

/// Adds the subcommand to `parent`.
void add_import_oni(CLI::App& parent);

}  // namespace roomwise
