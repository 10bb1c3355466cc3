#include "services/landmark_svc/core/virtual_scan.h"

#include <algorithm>
#include <cmath>
#include <span>

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

/// What of the way to the floor readings of the slice are at: at least and at most.
struct Slice {
  float least;
  float most;
};

/// Marks the columns of a row with a good reading within the slice; they may be none of the slice
/// by the rounding of a float. No branch and no table: compilers do many columns at once.
void mark_within(const std::uint16_t* steps, const DisparityTable& table, const RowLine& floor,
                 const Slice& slice, int u_begin_px, std::span<std::uint8_t> is_within) {
  const int nearest = table.smallest_good_step();
  const int farthest = table.largest_good_step();
  for (std::size_t i = 0; i < is_within.size(); ++i) {
    const int step = steps[i];
    const float ratio = static_cast<float>(step) * floor.at(u_begin_px + static_cast<int>(i));
    is_within[i] = static_cast<std::uint8_t>(
        static_cast<int>(step >= nearest) & static_cast<int>(step <= farthest) &
        static_cast<int>(ratio >= slice.least) & static_cast<int>(ratio <= slice.most));
  }
}

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
  is_within_.reserve(static_cast<std::size_t>(width_px));
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
  // A reading's share of the way to the floor along its ray, by its step.
  const Eigen::Vector3d gradient = table.depth_m(1) / floor.height_m * floor.down_camera;
  const Slice slice{static_cast<float>(1.0 - params.height_high_m / floor.height_m),
                    static_cast<float>(1.0 - params.height_low_m / floor.height_m)};

  columns_.assign(static_cast<std::size_t>(region.width_px()), Clusters{});
  is_within_.assign(static_cast<std::size_t>(region.width_px()), 0);
  const int step = std::max(1, params.row_step_px * depth.height_px / 480);
  constexpr float kToQuanta = 1.0F / DisparityTable::kPartsPerQuantum;
  for (int v = region.v_begin_px; v < region.v_end_px; v += step) {
    const RowLine along_ratio = row_line(along, camera, v);
    const std::uint16_t* const steps =
        depth.steps.data() +
        static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width_px) + region.u_begin_px;
    mark_within(steps, table, row_line(gradient, camera, v), slice, region.u_begin_px, is_within_);
    for (int u = region.u_begin_px; u < region.u_end_px; ++u) {
      const int i = u - region.u_begin_px;
      if (is_within_[static_cast<std::size_t>(i)] == 0) continue;
      const float quanta = static_cast<float>(table.parts(steps[i])) * kToQuanta;
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
