#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise::segment {

/// The recorded kitchen of the test data: 120 frames of a hand-held Kinect, with camera poses and,
/// for every fifth, a mask of the floor. Its folder must be there.
namespace recorded {

inline constexpr const char* kFolder = "rgbd_7scenes_redkitchen_000_119";
inline constexpr int kFrames = 120;

/// Camera poses in a world whose z is up, as gravity has it; the first one `height_m` up.
class Mounting {
 public:
  explicit Mounting(double height_m);
  /// T_robot_camera, the robot below the camera and looking its way.
  Eigen::Isometry3d operator()(int number) const;

 private:
  double height_m_;
  double first_m_ = 0.0;
  Eigen::Quaterniond level_;
};

/// Depth, and colour registered to it where asked for.
enum class Color { kNone, kRead };
RgbdFrame read_frame(int number, const Eigen::Isometry3d& T_robot_camera, Color color);

/// height x width: 255 floor, 0 not floor, 128 not known. Nothing for frames without a mask.
std::optional<std::vector<std::uint8_t>> read_floor_mask(int number);

}  // namespace recorded
}  // namespace roomwise::segment
