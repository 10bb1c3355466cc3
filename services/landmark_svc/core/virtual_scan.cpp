#include "services/landmark_svc/core/virtual_scan.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/multiversion.h"

namespace roomwise::landmark {
namespace {

/// Two readings of one column are of one thing if they differ by less: 2 quanta and 3 %.
constexpr float kApart_quanta = 2.0F;
constexpr float kApart_ratio = 0.03F;

constexpr std::size_t kMarksAtOnce = 8;

std::size_t whole_words(int width_px) {
  return (static_cast<std::size_t>(width_px) + kMarksAtOnce - 1) / kMarksAtOnce * kMarksAtOnce;
}

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

/// What a column of a row holds of the slice.
enum Within : std::uint8_t { kNothing = 0, kReading = 1, kReadingBeyond = 3 };

/// Which steps are readings.
struct Readings {
  int nearest;
  int farthest;         ///< good
  int farthest_beyond;  ///< or bad only because it is too far
};

/// Tells of each column of a row whether its reading is within the slice; it may be none of the
/// slice by the rounding of a float. No branch and no table: compilers do many columns at once.
ROOMWISE_MULTIVERSION
void mark_within(const std::uint16_t* steps, int width, const Readings& readings,
                 const RowLine& floor, const Slice& slice, int u_begin_px, std::uint8_t* within) {
  const auto [nearest, farthest, farthest_beyond] = readings;
  const auto [least, most] = slice;
  const auto [constant, per_column] = floor;
  for (int i = 0; i < width; ++i) {
    const int step = steps[i];
    const float floor_here = constant + per_column * static_cast<float>(u_begin_px + i);
    const float ratio = static_cast<float>(step) * floor_here;
    const int is_within = static_cast<int>(step >= nearest) &
                          static_cast<int>(step <= farthest_beyond) &
                          static_cast<int>(ratio >= least) & static_cast<int>(ratio <= most);
    const int is_beyond = is_within & static_cast<int>(step > farthest);
    within[i] = static_cast<std::uint8_t>(is_within | is_beyond << 1);
  }
}

/// Calls `visit(i)` for each column that holds something, skipping eight empty ones at a time.
/// Beyond the last column there are zeros up to a whole word.
template <class Visit>
void for_each_within(const std::vector<std::uint8_t>& within, Visit visit) {
  for (std::size_t first = 0; first < within.size(); first += kMarksAtOnce) {
    std::uint64_t word;
    std::memcpy(&word, within.data() + first, sizeof word);
    if (word == 0) continue;
    for (std::size_t i = first; i < first + kMarksAtOnce; ++i) {
      if (within[i] != kNothing) visit(i);
    }
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
  within_.reserve(whole_words(width_px));
  beyond_rows_.reserve(static_cast<std::size_t>(width_px));
  open_px_.reserve(static_cast<std::size_t>(width_px));
}

inline bool VirtualScan::Cluster::take(float quanta, std::int16_t v_px) {
  const float so_far = mean();
  if (!(std::abs(quanta - so_far) <= kApart_quanta + kApart_ratio * so_far)) return false;
  sum += quanta;
  ++rows;
  v_bottom_px = v_px;
  return true;
}

inline void VirtualScan::add(Clusters& clusters, float quanta, std::int16_t v_px) {
  for (Cluster& cluster : clusters) {
    if (cluster.rows > 0 && cluster.take(quanta, v_px)) return;
  }
  begin_cluster(clusters, quanta, v_px);
}

void VirtualScan::begin_cluster(Clusters& clusters, float quanta, std::int16_t v_px) {
  Cluster* place = nullptr;
  for (Cluster& cluster : clusters) {
    if (cluster.rows == 0) {
      if (!place || place->rows > 0) place = &cluster;
      continue;
    }
    const float mean = cluster.mean();
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
  clear();
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
  within_.assign(whole_words(region.width_px()), kNothing);
  beyond_rows_.assign(static_cast<std::size_t>(region.width_px()), 0);
  const int step = std::max(1, params.row_step_px * depth.height_px / 480);
  const Readings readings{table.smallest_good_step(), table.largest_good_step(),
                          table.largest_beyond_step()};
  constexpr float kToQuanta = 1.0F / DisparityTable::kPartsPerQuantum;
  for (int v = region.v_begin_px; v < region.v_end_px; v += step) {
    const RowLine along_ratio = row_line(along, camera, v);
    const std::uint16_t* const steps =
        depth.steps.data() +
        static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width_px) + region.u_begin_px;
    mark_within(steps, region.width_px(), readings, row_line(gradient, camera, v), slice,
                region.u_begin_px, within_.data());
    for_each_within(within_, [&](std::size_t i) {
      if (within_[i] == kReadingBeyond) {
        ++beyond_rows_[i];
        return;
      }
      const float quanta = static_cast<float>(table.parts(steps[i])) * kToQuanta;
      const float ratio = along_ratio.at(region.u_begin_px + static_cast<int>(i));
      if (ratio >= 0.1F) add(columns_[i], quanta / ratio, static_cast<std::int16_t>(v));
    });
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
    const Cluster* const nearest = nearest_of(columns_[column], rows_min);
    if (!nearest) {
      if (beyond_rows_[column] >= rows_min) open_px_.push_back(u);
      continue;
    }
    const double v = 0.5 * (nearest->v_top_px + nearest->v_bottom_px);
    const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px,
                              1.0);
    const double along_m = table.depth_from_quanta_m(static_cast<double>(nearest->mean()));
    const double left_m = along_m * left.dot(ray) / std::max(along.dot(ray), 0.1);
    points_.push_back({u, origin_m_ + along_m * forward_ + left_m * sideways, along_m,
                       nearest->rows, nearest->v_top_px, nearest->v_bottom_px});
  }
}

/// Null if none has that many rows.
const VirtualScan::Cluster* VirtualScan::nearest_of(const Clusters& clusters, double rows_min) {
  const Cluster* nearest = nullptr;
  for (const Cluster& cluster : clusters) {
    if (cluster.rows >= rows_min && (!nearest || cluster.mean() > nearest->mean())) {
      nearest = &cluster;
    }
  }
  return nearest;
}

}  // namespace roomwise::landmark
