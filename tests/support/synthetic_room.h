#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/pose2.h"
#include "common/image/rgbd_frame.h"

namespace roomwise {

/// An upright box standing in the world, sides along x and y.
struct SyntheticBox {
  Eigen::Vector3d low_m;   ///< corner with the smallest coordinates
  Eigen::Vector3d high_m;  ///< corner with the largest
  std::array<std::uint8_t, 3> rgb{128, 128, 128};
};

/// Boxes on a floor at z = 0. A wall is a thin box.
struct SyntheticRoom {
  std::vector<SyntheticBox> boxes;
  std::array<std::uint8_t, 3> floor_rgb{150, 120, 90};
  bool has_floor = true;
};

/// How the made camera looks at it.
struct SyntheticCamera {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 585.0;    ///< at 640 x 480; scaled with the width
  double height_m = 0.3;      ///< above the floor
  double pitch_rad = 0.0;     ///< positive looks down
  double noise_quanta = 0.3;  ///< sigma of the disparity error; 0: none
  double quantum_per_inverse_m =
      351.0;  ///< disparity quanta a 1/m: 8 f b; depth is rounded to them
};

/// A living-room corner: two walls, a box and a thin pole before them. Truth for eye and tests.
SyntheticRoom furnished_room();

/// Frame that `camera` on a robot at `T_world_robot` gets of `room`: depth in millimetres with the
/// Kinect's disparity quantum and noise, colour registered to it, readings from 0.5 to 8 m.
/// `seed` makes the noise; same arguments, same frame.
RgbdFrame render(const SyntheticRoom& room, const SyntheticCamera& camera,
                 const Pose2& T_world_robot, std::uint32_t seed);

}  // namespace roomwise
