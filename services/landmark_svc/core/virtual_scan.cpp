#include "services/landmark_svc/core/virtual_scan.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

/// Two readings of one column are of one thing if they differ by less: 2 quanta and 3 %.
constexpr float kApart_quanta = 2.0F;
constexpr float kApart_ratio = 0.03F;

/// Linear in the image: at column u of a row, constant + per_column u.
struct RowLine {
  float constant;
  float per_column;
  float at(int u_px) const { return constant + per_column * static_cast<float>(u_px); }
};

/// g . (x, y, 1) along row v.
RowLine row_line(const Eigen::Vector3d& g, const PinholeCamera& camera, int v_px) {
  const double y = (v_px - camera.cy_px) / camera.fy_px;
  return {static_cast<float>(g.z() + g.y() * y - g.x() * camera.cx_px / camera.fx_px),
          static_cast<float>(g.x() / camera.fx_px)};
}

}  // namespace

void VirtualScan::reserve(int width_px) {
  columns_.reserve(static_cast<std::size_t>(width_px));
  points_.reserve(static_cast<std::size_t>(width_px));
}

void VirtualScan::add(Clusters& clusters, float quanta, std::int16_t v_px) {
  Cluster* place = nullptr;
  for (Cluster& cluster : clusters) {
    if (cluster.rows == 0) {
      if (!place || place->rows > 0) place = &cluster;
      continue;
    }
    const float mean = cluster.mean();
    if (std::abs(quanta - mean) <= kApart_quanta + kApart_ratio * mean) {
      cluster.sum += quanta;
      ++cluster.rows;
      cluster.v_bottom_px = v_px;
      return;
    }
    // Full: the farthest gives way to what is nearer.
    const bool is_farther = mean < quanta && (!place || (place->rows > 0 && mean < place->mean()));
    if (is_farther) place = &cluster;
  }
  if (place) *place = {quanta, 1, v_px, v_px};
}

void VirtualScan::make(const DepthImage& depth, const PinholeCamera& camera,
                       const DisparityTable& table, const FloorView& floor,
                       const Eigen::Isometry3d& T_robot_camera, const PixelRectangle& region,
                       const VirtualScanParams& params) {
  points_.clear();
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d level = ahead - ahead.dot(floor.down_camera) * floor.down_camera;
  const Eigen::Vector3d mounted_ahead = T_robot_camera.linear().col(2);
  constexpr double kSteepest = 0.1;
  if (region.empty() || level.norm() < kSteepest || mounted_ahead.head<2>().norm() < kSteepest) {
    return;
  }
  const Eigen::Vector3d along = level.normalized();
  const Eigen::Vector3d left = -floor.down_camera.cross(along);
  forward_ = mounted_ahead.head<2>().normalized();
  origin_m_ = T_robot_camera.translation().head<2>();
  const Eigen::Vector3d gradient = table.quanta_m() / floor.height_m * floor.down_camera;
  const auto low = static_cast<float>(1.0 - params.height_low_m / floor.height_m);
  const auto high = static_cast<float>(1.0 - params.height_high_m / floor.height_m);

  columns_.assign(static_cast<std::size_t>(region.width_px()), Clusters{});
  const int step = std::max(1, params.row_step_px * depth.height_px / 480);
  constexpr float kToQuanta = 1.0F / DisparityTable::kPartsPerQuantum;
  for (int v = region.v_begin_px; v < region.v_end_px; v += step) {
    const RowLine floor_quanta = row_line(gradient, camera, v);
    const RowLine along_ratio = row_line(along, camera, v);
    for (int u = region.u_begin_px; u < region.u_end_px; ++u) {
      const float quanta = static_cast<float>(table.parts(depth.at(u, v))) * kToQuanta;
      const float of_floor = floor_quanta.at(u);
      if (quanta <= 0.0F || of_floor > low * quanta || of_floor < high * quanta) continue;
      const float ratio = along_ratio.at(u);
      if (ratio < 0.1F) continue;
      add(columns_[static_cast<std::size_t>(u - region.u_begin_px)], quanta / ratio,
          static_cast<std::int16_t>(v));
    }
  }

  const double rows_min = std::max(2.0, params.rows_min_px * depth.height_px / 480.0);
  const Eigen::Vector2d sideways(-forward_.y(), forward_.x());
  for (int u = region.u_begin_px; u < region.u_end_px; ++u) {
    const Cluster* nearest = nullptr;
    for (const Cluster& c : columns_[static_cast<std::size_t>(u - region.u_begin_px)]) {
      if (c.rows >= rows_min && (!nearest || c.mean() > nearest->mean())) nearest = &c;
    }
    if (!nearest) continue;
    const double v = 0.5 * (nearest->v_top_px + nearest->v_bottom_px);
    const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px,
                              1.0);
    const double along_m = table.depth_from_quanta_m(static_cast<double>(nearest->mean()));
    const double left_m = along_m * left.dot(ray) / std::max(along.dot(ray), 0.1);
    points_.push_back({u, origin_m_ + along_m * forward_ + left_m * sideways, along_m,
                       nearest->rows, nearest->v_top_px, nearest->v_bottom_px});
  }
}

}  // namespace roomwise::landmark
