#include "logs/tools/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace roomwise {
namespace {

constexpr std::array<std::uint8_t, 3> kGrey = {128, 128, 128};

std::array<std::uint8_t, 3> color_at(const RgbdFrame& frame, const Eigen::Vector3d& p_m) {
  const PinholeCamera& camera = frame.color_camera;
  if (frame.color.empty()) return kGrey;
  const double u = std::round(camera.fx_px * p_m.x() / p_m.z() + camera.cx_px);
  const double v = std::round(camera.fy_px * p_m.y() / p_m.z() + camera.cy_px);
  const bool inside = u >= 0.0 && v >= 0.0 && u < frame.color.width_px && v < frame.color.height_px;
  if (!inside) return kGrey;
  const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(frame.color.width_px) +
                     static_cast<std::size_t>(u);
  const std::uint8_t* rgb = &frame.color.rgb[3 * pixel];
  return {rgb[0], rgb[1], rgb[2]};
}

/// 21 bits an axis: 1000 m in steps of a millimetre, both ways.
std::uint64_t cube_of(const Eigen::Vector3d& p_m, double voxel_m) {
  constexpr std::int64_t kMiddle = 1 << 20;
  std::uint64_t cube = 0;
  for (const double x_m : p_m) {
    const auto step = static_cast<std::int64_t>(std::floor(x_m / voxel_m)) + kMiddle;
    cube = cube << 21U | static_cast<std::uint64_t>(step);
  }
  return cube;
}

}  // namespace

PointCloud points_of(const RgbdFrame& frame, double range_max_m) {
  PointCloud cloud;
  const PinholeCamera& camera = frame.depth_camera;
  for (int v = 0; v < frame.depth.height_px; ++v) {
    for (int u = 0; u < frame.depth.width_px; ++u) {
      const double z_m = frame.depth.at(u, v) * frame.depth.unit_m;
      if (z_m <= 0.0 || z_m > range_max_m) continue;
      const Eigen::Vector3d p_m(z_m * (u - camera.cx_px) / camera.fx_px,
                                z_m * (v - camera.cy_px) / camera.fy_px, z_m);
      cloud.push_back({p_m.cast<float>(), color_at(frame, p_m)});
    }
  }
  return cloud;
}

VoxelGrid::VoxelGrid(double voxel_m) : voxel_m_(voxel_m) {
  if (!(voxel_m >= kSmallestVoxel_m && voxel_m <= 10.0)) {
    throw std::invalid_argument("a voxel must be 0.001 m to 10 m wide");
  }
}

void VoxelGrid::add(const PointCloud& cloud, const Eigen::Isometry3d& T_b_a) {
  for (const ColoredPoint& point : cloud) {
    const Eigen::Vector3d p_m = T_b_a * point.p_m.cast<double>();
    if (!(p_m.cwiseAbs().maxCoeff() < kReach_m)) continue;
    Sum& sum = sums_[cube_of(p_m, voxel_m_)];
    sum.p_m += p_m;
    sum.rgb += Eigen::Vector3d(point.rgb[0], point.rgb[1], point.rgb[2]);
    ++sum.count;
  }
}

PointCloud VoxelGrid::thinned() const {
  std::vector<std::uint64_t> cubes;
  cubes.reserve(sums_.size());
  for (const auto& [cube, sum] : sums_) cubes.push_back(cube);
  std::ranges::sort(cubes);
  PointCloud cloud;
  cloud.reserve(cubes.size());
  for (const std::uint64_t cube : cubes) {
    const Sum& sum = sums_.at(cube);
    const auto count = static_cast<double>(sum.count);
    ColoredPoint point{.p_m = (sum.p_m / count).cast<float>(), .rgb = {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const double level = sum.rgb[static_cast<Eigen::Index>(i)] / count;
      point.rgb[i] = static_cast<std::uint8_t>(std::lround(level));
    }
    cloud.push_back(point);
  }
  return cloud;
}

}  // namespace roomwise
