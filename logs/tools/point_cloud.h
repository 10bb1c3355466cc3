#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise {

/// A place and its colour.
struct ColoredPoint {
  Eigen::Vector3f p_m = Eigen::Vector3f::Zero();
  std::array<std::uint8_t, 3> rgb{};

  bool operator==(const ColoredPoint&) const = default;
};

using PointCloud = std::vector<ColoredPoint>;

/// A frame's depth readings up to `range_max_m` along the camera's z, in the camera's frame, row by
/// row. With pixel (u, v) and depth z: p = z ((u - cx) / fx, (v - cy) / fy, 1). The colour is that
/// of the pixel the point falls on in the colour camera, taken to sit where the depth camera sits;
/// mid grey where there is none.
PointCloud points_of(const RgbdFrame& frame, double range_max_m);

/// Thins clouds: all points of one cube of space become their mean. Reaches 1000 m from the origin;
/// points beyond are left out.
class VoxelGrid {
 public:
  static constexpr double kReach_m = 1000.0;
  static constexpr double kSmallestVoxel_m = 0.001;

  /// Throws std::invalid_argument if `voxel_m` is not in [0.001, 10].
  explicit VoxelGrid(double voxel_m);

  /// Adds `cloud`, which stands in the frame a, to a grid in the frame b.
  void add(const PointCloud& cloud, const Eigen::Isometry3d& T_b_a);

  /// The means, in order of their cubes: the same points in the same order give the same bytes.
  PointCloud thinned() const;

 private:
  struct Sum {
    Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
    std::int64_t count = 0;
  };
  double voxel_m_;
  std::unordered_map<std::uint64_t, Sum> sums_;
};

}  // namespace roomwise
