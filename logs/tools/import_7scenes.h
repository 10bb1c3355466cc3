#pragma once
#include <filesystem>
#include <iosfwd>

namespace roomwise {

struct SevenScenesImport {
  std::filesystem::path folder{};
  std::filesystem::path out{};
  double camera_height_m = 1.2;  ///< of the first camera above the floor; the set does not say
};

/// Makes a log of a 7-Scenes folder (Shotton et al., CVPR 2013): frame-N.depth.png in millimetres
/// with 0 and 65535 for no reading, frame-N.color.jpg or .png, and where present frame-N.pose.txt
/// (camera to world, metres), camera-intrinsics.txt and gravity-direction.txt (down, in the world).
///
/// KINECT_FRAME.seq is N + 1 and utime is 2013-01-01 00:00 UTC + N / 30 s: the set has no times.
/// TRUTH's world has its origin on the floor below the first camera, z up, x along its optical axis
/// as seen from above. Says on `notes` what it assumed. The same folder gives the same bytes.
///
/// Throws std::runtime_error naming the file (and line) at fault; `out` then stays as it was.
void import_7scenes(const SevenScenesImport& import, std::ostream& notes);

}  // namespace roomwise
