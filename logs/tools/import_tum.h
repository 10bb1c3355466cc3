#pragma once
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "common/image/rgbd_frame.h"

namespace roomwise {

struct TumImport {
  std::filesystem::path folder{};
  std::filesystem::path out{};
  std::optional<PinholeCamera> camera{};  ///< none: by the folder's name, said aloud
  double depth_scale = 5000.0;            ///< depth steps a metre
  double camera_height_m = 1.2;           ///< used where there is no truth
};

/// Makes a log of a TUM RGB-D folder (Sturm et al., IROS 2012): rgb.txt and depth.txt (time, file),
/// and where present groundtruth.txt (time tx ty tz qx qy qz qw, camera to world, z up).
///
/// Each depth image goes with the colour image nearest in time, at most 20 ms away; what has no
/// partner is left out and counted. KINECT_FRAME.utime is the depth image's. Depth steps stay as
/// they are, colour becomes JPEG of quality 90. TRUTH comes at its own rate in the set's own world.
/// Says on `notes` what it assumed. The same folder gives the same bytes.
///
/// Throws std::runtime_error naming the file (and line) at fault; `out` then stays as it was.
void import_tum(const TumImport& import, std::ostream& notes);

}  // namespace roomwise
