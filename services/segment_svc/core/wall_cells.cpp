#include "services/segment_svc/core/wall_cells.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/multiversion.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr int kCell_px = 16;
constexpr int kStride_px = 2;        // every second pixel each way says enough
constexpr float kPixelsMin = 24.0F;  // of 64
constexpr float kResidual_quanta = 1.5F;
constexpr float kOnWall_quanta = 4.0F;     // a pixel, against its own or a neighbour's plane
constexpr float kWallFoot_quanta = 0.75F;  // between wall and floor that differ by less, the wall
constexpr float kFarInFront_per_m = 1e6F;  // no wall stands so far in front of the floor
constexpr float kUpright = 0.2F;           // |cosine| between a wall's normal and up
constexpr float kSameNormal = 0.95F;       // cosine: 18 degrees
constexpr float kWidth_m = 0.5F;
constexpr float kHeight_m = 0.6F;

/// Adds a row's obstacle pixels to the sums of their columns, of 1, y and w = 1 / depth and of
/// their products. A column's x is the same in all rows: it is brought in when columns become
/// cells.
ROOMWISE_MULTIVERSION
void add_row(const std::uint16_t* steps, const std::uint8_t* labels, float y, float unit_m,
             std::size_t columns, float* __restrict n, float* __restrict ny, float* __restrict nyy,
             float* __restrict w, float* __restrict wy, float* __restrict ww) {
  for (std::size_t i = 0; i < columns; ++i) {
    const std::size_t u = kStride_px * i;
    const float is_obstacle = labels[u] == kObstacle ? 1.0F : 0.0F;
    const float z_m = unit_m * static_cast<float>(steps[u] > 0 ? steps[u] : 1);
    const float per_m = is_obstacle / z_m;
    n[i] += is_obstacle;
    ny[i] += is_obstacle * y;
    nyy[i] += is_obstacle * y * y;
    w[i] += per_m;
    wy[i] += per_m * y;
    ww[i] += per_m * per_m;
  }
}

/// Which pixels on a wall become wall, as bits: those of something standing, its foot on the floor.
constexpr std::uint8_t kStanding = 1;
constexpr std::uint8_t kFoot = 2;
constexpr std::uint8_t kAnything = kStanding | kFoot;

/// What tells wall from floor; planes by their 1 / z = m . (x, y, 1) on a ray.
struct OnWallRule {
  float wall[3];
  float floor[3];
  float unit_m;
  float off_per_m;
  float behind_per_m;
};

/// A cell's rows, `width` pixels apart, each as many pixels as a cell is wide, so that the compiler
/// knows how many. Numbers of one size at a time: it then takes many at once.
ROOMWISE_MULTIVERSION
void relabel_rows(const std::uint16_t* steps, const float* ray_x, const float* ray_y,
                  OnWallRule rule, std::size_t rows, std::size_t width,
                  std::uint8_t* __restrict labels) {
  using Row = std::array<float, kCell_px>;
  std::array<Row, kCell_px> z_m;
  std::array<std::array<std::int32_t, kCell_px>, kCell_px> becomes_wall;
  std::array<std::array<std::uint8_t, kCell_px>, kCell_px> change;
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t i = 0; i < kCell_px; ++i) {
      z_m[v][i] = rule.unit_m * static_cast<float>(steps[v * width + i]);
    }
  }
  for (std::size_t v = 0; v < rows; ++v) {
    const float wall_of_row = rule.wall[1] * ray_y[v] + rule.wall[2];
    const float floor_of_row = rule.floor[1] * ray_y[v] + rule.floor[2];
    for (std::size_t i = 0; i < kCell_px; ++i) {
      const float wall_per_m = rule.wall[0] * ray_x[i] + wall_of_row;
      const float floor_per_m = rule.floor[0] * ray_x[i] + floor_of_row;
      const float off = std::abs(wall_per_m * z_m[v][i] - 1.0F) - rule.off_per_m * z_m[v][i];
      const int if_on_wall = wall_per_m + rule.behind_per_m > floor_per_m ? kAnything : kStanding;
      becomes_wall[v][i] = off <= 0.0F ? if_on_wall : 0;
    }
  }
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t i = 0; i < kCell_px; ++i) {
      change[v][i] = static_cast<std::uint8_t>(becomes_wall[v][i]);
    }
  }
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t i = 0; i < kCell_px; ++i) {
      const std::uint8_t label = labels[v * width + i];
      std::uint8_t is_meant = label == kObstacle ? kStanding : 0;
      is_meant = label == kAccessible ? kFoot : is_meant;
      labels[v * width + i] = (change[v][i] & is_meant) != 0 ? std::uint8_t{kWall} : label;
    }
  }
}

}  // namespace

void WallCells::mark(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
                     std::vector<std::uint8_t>& labels) {
  quantum_per_m_ = view.quantum_per_m();
  columns_ = (view.width_px() + kCell_px - 1) / kCell_px;
  rows_ = (view.height_px() + kCell_px - 1) / kCell_px;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  members_.reserve(cells_.size());
  patch_is_wall_.reserve(cells_.size());
  for (int row = 0; row < rows_; ++row) {
    sum_columns(frame, view, labels, row);
    for (int column = 0; column < columns_; ++column) {
      cells_[static_cast<std::size_t>(row * columns_ + column)] = fit(view, floor, column, row);
    }
  }
  join(floor);
  relabel(frame, view, floor, labels);
}

/// Row of a cell's middle.
std::size_t WallCells::middle_row(const CameraView& view, int row) {
  const int end = std::min((row + 1) * kCell_px, view.height_px());
  return static_cast<std::size_t>((row * kCell_px + end) / 2);
}

void WallCells::sum_columns(const RgbdFrame& frame, const CameraView& view,
                            const std::vector<std::uint8_t>& labels, int row) {
  const auto width = static_cast<std::size_t>(view.width_px());
  const std::size_t count = (width + kStride_px - 1) / kStride_px;
  for (auto* sums : {&sums_.n, &sums_.ny, &sums_.nyy, &sums_.w, &sums_.wy, &sums_.ww}) {
    sums->assign(count, 0.0F);
  }
  const float middle_y = view.ray_y()[middle_row(view, row)];
  const int v_end = std::min((row + 1) * kCell_px, view.height_px());
  for (int v = row * kCell_px; v < v_end; v += kStride_px) {
    const std::size_t first = static_cast<std::size_t>(v) * width;
    add_row(frame.depth.steps.data() + first, labels.data() + first,
            view.ray_y()[static_cast<std::size_t>(v)] - middle_y, static_cast<float>(view.unit_m()),
            count, sums_.n.data(), sums_.ny.data(), sums_.nyy.data(), sums_.w.data(),
            sums_.wy.data(), sums_.ww.data());
  }
}

/// Least squares of 1 / depth = m0 . (x, y, 1) over the obstacle pixels of a cell.
WallCells::Cell WallCells::fit(const CameraView& view, const FloorPlane& floor, int column,
                               int row) const {
  const int u_end = std::min((column + 1) * kCell_px, view.width_px());
  const float x0 = view.ray_x()[static_cast<std::size_t>((column * kCell_px + u_end) / 2)];
  const float y0 = view.ray_y()[middle_row(view, row)];
  Eigen::Matrix3f normal_matrix = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right_side = Eigen::Vector3f::Zero();
  float sum_squared = 0.0F;
  for (int u = column * kCell_px; u < u_end; u += kStride_px) {
    const auto i = static_cast<std::size_t>(u / kStride_px);
    const float x = view.ray_x()[static_cast<std::size_t>(u)] - x0;
    const float n = sums_.n[i];
    const float ny = sums_.ny[i];
    Eigen::Matrix3f products;
    products << x * x * n, x * ny, x * n, x * ny, sums_.nyy[i], ny, x * n, ny, n;
    normal_matrix += products;
    right_side += Eigen::Vector3f(x * sums_.w[i], sums_.wy[i], sums_.w[i]);
    sum_squared += sums_.ww[i];
  }
  const float count = normal_matrix(2, 2);
  Cell cell;
  if (count < kPixelsMin) return cell;
  const Eigen::Vector3f m0 = normal_matrix.ldlt().solve(right_side);
  const float mean_squared = (sum_squared - m0.dot(right_side)) / count;
  const float residual_quanta = std::sqrt(std::max(0.0F, mean_squared)) / quantum_per_m_;
  cell.m = Eigen::Vector3f(m0.x(), m0.y(), m0.z() - m0.x() * x0 - m0.y() * y0);
  const float rise = cell.m.normalized().dot(floor.normal.cast<float>());
  cell.is_upright =
      residual_quanta < kResidual_quanta && std::abs(rise) < kUpright && m0.z() > 0.0F;
  cell.p_camera_m = Eigen::Vector3f(x0, y0, 1.0F) / std::max(m0.z(), 1e-3F);
  return cell;
}

void WallCells::join(const FloorPlane& floor) {
  patch_is_wall_.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!cells_[i].is_upright || cells_[i].patch >= 0) continue;
    grow(i, static_cast<int>(patch_is_wall_.size()));
    patch_is_wall_.push_back(is_wall(floor) ? 1 : 0);
  }
}

void WallCells::grow(std::size_t start, int patch) {
  members_.assign(1, start);
  cells_[start].patch = patch;
  for (std::size_t next = 0; next < members_.size(); ++next) {
    const auto i = static_cast<int>(members_[next]);
    const int column = i % columns_;
    const auto visit = [&](bool exists, int j) {
      if (!exists) return;
      Cell& neighbour = cells_[static_cast<std::size_t>(j)];
      if (!neighbour.is_upright || neighbour.patch >= 0) return;
      if (!are_one_plane(cells_[static_cast<std::size_t>(i)], neighbour)) return;
      neighbour.patch = patch;
      members_.push_back(static_cast<std::size_t>(j));
    };
    visit(column > 0, i - 1);
    visit(column + 1 < columns_, i + 1);
    visit(i >= columns_, i - columns_);
    visit(i + columns_ < columns_ * rows_, i + columns_);
  }
}

bool WallCells::are_one_plane(const Cell& a, const Cell& b) const {
  const float z_m = b.p_camera_m.z();
  const float tolerance_m = 0.05F + 2.0F * z_m * z_m * quantum_per_m_;
  const float offset_m = std::abs(a.m.dot(b.p_camera_m) - 1.0F) / a.m.norm();
  return a.m.normalized().dot(b.m.normalized()) > kSameNormal && offset_m < tolerance_m;
}

/// Whether the members reach far enough, up and along the floor.
bool WallCells::is_wall(const FloorPlane& floor) const {
  const Eigen::Vector3f up = floor.normal.cast<float>();
  const Eigen::Vector3f along = up.cross(cells_[members_.front()].m).normalized();
  float low = 1e9F;
  float high = -1e9F;
  float first = 1e9F;
  float last = -1e9F;
  for (const std::size_t member : members_) {
    const Eigen::Vector3f& p = cells_[member].p_camera_m;
    low = std::min(low, up.dot(p));
    high = std::max(high, up.dot(p));
    first = std::min(first, along.dot(p));
    last = std::max(last, along.dot(p));
  }
  return high - low > kHeight_m && last - first > kWidth_m;
}

bool WallCells::is_wall_cell(int column, int row) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
  const int patch = cells_[static_cast<std::size_t>(row * columns_ + column)].patch;
  return patch >= 0 && patch_is_wall_[static_cast<std::size_t>(patch)] != 0;
}

void WallCells::relabel(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
                        std::vector<std::uint8_t>& labels) const {
  // On the floor 1 / z = floor_m . ray.
  const Eigen::Vector3f floor_m = (-floor.normal / floor.height_m).cast<float>();
  const auto relabel = [&](int column, int row, const Eigen::Vector3f& plane_m, Foot foot) {
    relabel_cell(frame, view, column, row, plane_m, floor_m, foot, labels);
  };
  constexpr std::array<std::array<int, 2>, 5> kSelfThenBeside = {
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      for (const auto& [right, down] : kSelfThenBeside) {
        if (!is_wall_cell(column + right, row + down)) continue;
        const auto i = static_cast<std::size_t>((row + down) * columns_ + column + right);
        relabel(column, row, cells_[i].m, Foot::kIsWall);
        if (right == 0 && down == 0) break;
      }
    }
    close_holes(row, relabel);
  }
}

/// Between cells of one wall, what lies on its plane is that wall: so the strip below a mirror is.
/// Between cells of two walls in one plane that is so of what stands there; floor there may be a
/// doorway's.
template <class Relabel>
void WallCells::close_holes(int row, const Relabel& relabel) const {
  const Cell* before = nullptr;  // the last wall cell
  int first_hole = 0;
  for (int column = 0; column < columns_; ++column) {
    if (!is_wall_cell(column, row)) continue;
    const Cell& wall = cells_[static_cast<std::size_t>(row * columns_ + column)];
    if (before != nullptr && are_one_plane(*before, wall)) {
      const Foot foot = before->patch == wall.patch ? Foot::kIsWall : Foot::kStaysFloor;
      for (int hole = first_hole; hole < column; ++hole) relabel(hole, row, wall.m, foot);
    }
    before = &wall;
    first_hole = column + 1;
  }
}

/// Turns the cell's obstacle pixels that lie on the plane into wall, and floor pixels that lie on
/// it too where it stands before the floor: the wall's foot.
void WallCells::relabel_cell(const RgbdFrame& frame, const CameraView& view, int column, int row,
                             const Eigen::Vector3f& plane_m, const Eigen::Vector3f& floor_m,
                             Foot foot, std::vector<std::uint8_t>& labels) const {
  const int u_end = std::min((column + 1) * kCell_px, view.width_px());
  const int v_end = std::min((row + 1) * kCell_px, view.height_px());
  // A cell that the image's side cuts takes in its neighbour's last pixels; images are at least as
  // wide as a cell.
  const auto first = static_cast<std::size_t>(std::max(0, u_end - kCell_px));
  const auto top = static_cast<std::size_t>(row * kCell_px);
  const auto width = static_cast<std::size_t>(view.width_px());
  const std::size_t pixel = top * width + first;
  relabel_rows(frame.depth.steps.data() + pixel, view.ray_x().data() + first,
               view.ray_y().data() + top,
               {.wall = {plane_m.x(), plane_m.y(), plane_m.z()},
                .floor = {floor_m.x(), floor_m.y(), floor_m.z()},
                .unit_m = static_cast<float>(view.unit_m()),
                .off_per_m = kOnWall_quanta * quantum_per_m_,
                .behind_per_m =
                    foot == Foot::kIsWall ? kWallFoot_quanta * quantum_per_m_ : -kFarInFront_per_m},
               static_cast<std::size_t>(v_end) - top, width, labels.data() + pixel);
}

}  // namespace roomwise::segment
