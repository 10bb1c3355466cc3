#include "services/landmark_svc/core/virtual_scan.h"

#include <algorithm>
#include <cmath>

#include "common/multiversion.h"

namespace roomwise::landmark {
namespace {

/// Rays that go up or down more steeply are left out.
constexpr float kAlongMin = 0.1F;

/// Linear in the image: at column u of a row, constant + per_column u.
struct RowLine {
  float constant;
  float per_column;
};

/// What of the way to the floor readings of the slice are at: at least and at most.
struct Slice {
  float least;
  float most;
};

/// Which steps are readings.
struct Readings {
  int nearest;
  int farthest;         ///< good
  int farthest_beyond;  ///< or bad only because it is too far
};

/// A row of depth steps, from column `u_begin_px` on.
struct Row {
  const std::uint16_t* steps;
  int width;
  int u_begin_px;
};

/// Writes the reading of each column of a row that is within the slice as Q / r [quanta], 0 for
/// none, and counts in `beyond_rows` those that are too far. A reading at the slice's border may
/// fall on either side by the rounding of a float. `quanta_steps`: disparity [quanta] times step.
/// No branch and no table: compilers do many columns at once.
ROOMWISE_MULTIVERSION
void read_row(const Row& row, const Readings& readings, const RowLine& floor, const Slice& slice,
              const RowLine& along, float quanta_steps, float* __restrict quanta,
              std::uint16_t* __restrict beyond_rows) {
  const auto [nearest, farthest, farthest_beyond] = readings;
  const auto [least, most] = slice;
  const auto [floor_constant, floor_per_column] = floor;
  const auto [along_constant, along_per_column] = along;
  const std::uint16_t* __restrict steps = row.steps;
  const int width = row.width;
  const int u_begin_px = row.u_begin_px;
  for (int i = 0; i < width; ++i) {
    const int step = steps[i];
    const auto u = static_cast<float>(u_begin_px + i);
    const float r = along_constant + along_per_column * u;
    const float ratio = static_cast<float>(step) * (floor_constant + floor_per_column * u);
    const int is_within = static_cast<int>(step >= nearest) &
                          static_cast<int>(step <= farthest_beyond) &
                          static_cast<int>(ratio >= least) & static_cast<int>(ratio <= most);
    const int is_beyond = is_within & static_cast<int>(step > farthest);
    const int is_reading = is_within & (is_beyond ^ 1) & static_cast<int>(r >= kAlongMin);
    const float reading = quanta_steps / (static_cast<float>(step) * r);
    quanta[i] = is_reading ? reading : 0.0F;
    beyond_rows[i] = static_cast<std::uint16_t>(beyond_rows[i] + is_beyond);
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
  clusters_.reserve(static_cast<std::size_t>(width_px));
  quanta_.reserve(ScanClusters::padded(static_cast<std::size_t>(width_px)));
  points_.reserve(static_cast<std::size_t>(width_px));
  beyond_rows_.reserve(static_cast<std::size_t>(width_px));
  open_px_.reserve(static_cast<std::size_t>(width_px));
}

void VirtualScan::make(const DepthImage& depth, const PinholeCamera& camera,
                       const DisparityTable& table, const FloorView& floor,
                       const Eigen::Isometry3d& T_robot_camera, const PixelRectangle& region,
                       const VirtualScanParams& params) {
  clear();
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d level = ahead - ahead.dot(floor.down_camera) * floor.down_camera;
  const Eigen::Vector3d mounted_ahead = T_robot_camera.linear().col(2);
  constexpr double kSteepest = kAlongMin;
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

  clusters_.clear(static_cast<std::size_t>(region.width_px()));
  quanta_.assign(ScanClusters::padded(static_cast<std::size_t>(region.width_px())), 0.0F);
  beyond_rows_.assign(static_cast<std::size_t>(region.width_px()), 0);
  const int step = std::max(1, params.row_step_px * depth.height_px / 480);
  const Readings readings{table.smallest_good_step(), table.largest_good_step(),
                          table.largest_beyond_step()};
  const auto quanta_steps = static_cast<float>(table.quanta_steps());
  for (int v = region.v_begin_px; v < region.v_end_px; v += step) {
    const std::uint16_t* const steps =
        depth.steps.data() +
        static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width_px) + region.u_begin_px;
    read_row({steps, region.width_px(), region.u_begin_px}, readings, row_line(gradient, camera, v),
             slice, row_line(along, camera, v), quanta_steps, quanta_.data(), beyond_rows_.data());
    clusters_.add_row(v, quanta_.data());
  }
  place_points(camera, table, along, left, region,
               std::max(2.0, params.rows_min_px * depth.height_px / 480.0));
}

/// Points or open columns from what the columns hold. `along`, `left`: the level viewing direction
/// and its left, in the camera frame.
void VirtualScan::place_points(const PinholeCamera& camera, const DisparityTable& table,
                               const Eigen::Vector3d& along, const Eigen::Vector3d& left,
                               const PixelRectangle& region, double rows_min) {
  const Eigen::Vector2d sideways(-forward_.y(), forward_.x());
  for (int u = region.u_begin_px; u < region.u_end_px; ++u) {
    const auto column = static_cast<std::size_t>(u - region.u_begin_px);
    const auto nearest = clusters_.nearest(column, rows_min);
    if (!nearest) {
      if (beyond_rows_[column] >= rows_min) open_px_.push_back(u);
      continue;
    }
    const double v = 0.5 * (nearest->v_top_px + nearest->v_bottom_px);
    const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px,
                              1.0);
    const double along_m = table.depth_from_quanta_m(static_cast<double>(nearest->quanta));
    const double left_m = along_m * left.dot(ray) / std::max<double>(along.dot(ray), kAlongMin);
    points_.push_back({u, origin_m_ + along_m * forward_ + left_m * sideways, along_m,
                       nearest->rows, nearest->v_top_px, nearest->v_bottom_px});
  }
}

}  // namespace roomwise::landmark
