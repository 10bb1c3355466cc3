#include "services/landmark_svc/core/floor_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr double kHeightMin_m = 0.05;
constexpr double kHeightMax_m = 3.0;
constexpr int kColumns = 80;  // about: never twice as many
constexpr int kPointsFewest = 40;
constexpr double kPriorSigma_ratio = 0.05;
constexpr double kCosTurnMax = 0.966;  // 15 degrees
constexpr std::array<double, 3> kBands_m = {0.10, 0.05, 0.03};
constexpr double kNoise_quanta = 2.0;

using GridRow = Eigen::Array<float, Eigen::Dynamic, 1, 0, 2 * kColumns, 1>;  // on the stack

/// Which columns or rows of an image make the grid.
struct GridLine {
  int first_px;
  int stride_px;
  int count;
};

/// Odd, so that a grid can lie in the middle of an even number of columns.
int stride_px(int width_px) { return (width_px / kColumns) | 1; }

/// In the middle: what a mirrored image shows is seen at mirrored places.
GridLine columns_of(int width_px) {
  const int stride = stride_px(width_px);
  const int most = (width_px - 1) / stride + 1;
  const int count = (most - width_px) % 2 == 0 ? most : most - 1;
  return {(width_px - 1 - (count - 1) * stride) / 2, stride, count};
}

GridLine rows_of(int width_px, int height_px) {
  const int stride = stride_px(width_px);
  const int first = std::min(stride / 2, height_px - 1);
  return {first, stride, (height_px - 1 - first) / stride + 1};
}

/// Whether no good reading of a row can be within the band: above the horizon, and where the floor
/// is farther than any. `farthest_quanta` is what the farthest good reading has.
bool holds_no_floor(const Eigen::Vector3d& gradient, double y, double x_first, double x_last,
                    double band_ratio, double farthest_quanta) {
  constexpr double kRounding_quanta = 1.0;
  const double most_quanta =
      gradient.y() * y + gradient.z() + std::max(gradient.x() * x_first, gradient.x() * x_last);
  return most_quanta + kNoise_quanta + kRounding_quanta < (1.0 - band_ratio) * farthest_quanta;
}

}  // namespace

/// Normal equations of one round.
struct FloorFitter::Round {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double points = 0.0;

  /// Of a row at `y` with readings at `x`: y and 1 are the same for all of them.
  void add(const GridRow& counts, const GridRow& x, const GridRow& off, double y) {
    const double n = counts.sum();
    const double sum_x = (counts * x).sum();
    const double sum_off = (counts * off).sum();
    const Eigen::Vector3d sum(sum_x, n * y, n);
    normal(0, 0) += (counts * x * x).sum();
    normal(1, 0) += y * sum.x();
    normal.block<1, 2>(1, 1) += y * sum.tail<2>().transpose();
    normal.row(2) += sum.transpose();
    right += Eigen::Vector3d((counts * x * off).sum(), sum_off * y, sum_off);
    points += n;
  }
};

void FloorFitter::reserve(int width_px, int height_px) {
  const auto rows = static_cast<std::size_t>(rows_of(width_px, height_px).count);
  quanta_.reserve(rows * static_cast<std::size_t>(columns_of(width_px).count));
  is_looked_up_.reserve(rows);
}

const float* FloorFitter::row_quanta(const DepthImage& depth, const DisparityTable& table,
                                     int row) {
  const GridLine columns = columns_of(depth.width_px);
  const GridLine rows = rows_of(depth.width_px, depth.height_px);
  float* const quanta =
      quanta_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(columns.count);
  std::uint8_t& is_looked_up = is_looked_up_[static_cast<std::size_t>(row)];
  if (is_looked_up != 0) return quanta;
  is_looked_up = 1;
  const auto v = static_cast<std::size_t>(rows.first_px + row * rows.stride_px);
  const std::uint16_t* steps =
      depth.steps.data() + v * static_cast<std::size_t>(depth.width_px) + columns.first_px;
  for (int k = 0; k < columns.count; ++k, steps += columns.stride_px) {
    quanta[k] = static_cast<float>(table.parts(*steps)) /
                static_cast<float>(DisparityTable::kPartsPerQuantum);
  }
  return quanta;
}

/// Only the lower triangle of the normal equations is filled.
FloorFitter::Round FloorFitter::gather_near(const DepthImage& depth, const PinholeCamera& camera,
                                            const DisparityTable& table,
                                            const Eigen::Vector3d& gradient, double band_ratio) {
  Round round;
  const GridLine columns = columns_of(depth.width_px);
  const GridLine rows = rows_of(depth.width_px, depth.height_px);
  GridRow x(columns.count);
  for (int k = 0; k < columns.count; ++k) {
    x[k] = static_cast<float>((columns.first_px + k * columns.stride_px - camera.cx_px) /
                              camera.fx_px);
  }
  const auto band = static_cast<float>(band_ratio);
  constexpr auto kNoise = static_cast<float>(kNoise_quanta);
  GridRow off(columns.count);
  GridRow counts(columns.count);
  const double farthest_quanta = table.quanta_m() / DisparityTable::kDepthMax_m;
  const auto x_first = static_cast<double>(x[0]);
  const auto x_last = static_cast<double>(x[columns.count - 1]);
  for (int row = 0; row < rows.count; ++row) {
    const double y = (rows.first_px + row * rows.stride_px - camera.cy_px) / camera.fy_px;
    if (holds_no_floor(gradient, y, x_first, x_last, band_ratio, farthest_quanta)) continue;
    const Eigen::Map<const GridRow> quanta(row_quanta(depth, table, row), columns.count);
    const auto of_row = static_cast<float>(gradient.y() * y + gradient.z());
    off = quanta - of_row - static_cast<float>(gradient.x()) * x;
    for (int k = 0; k < columns.count;
         ++k) {  // as a loop, or it is not done many columns at a time
      const bool is_near = std::abs(off[k]) <= band * quanta[k] + kNoise;
      counts[k] =
          static_cast<float>(static_cast<int>(is_near) & static_cast<int>(quanta[k] > 0.0F));
    }
    round.add(counts, x, off, y);
  }
  return round;
}

std::optional<FloorView> FloorFitter::fit(const DepthImage& depth, const PinholeCamera& camera,
                                          const DisparityTable& table,
                                          const Eigen::Isometry3d& T_robot_camera) {
  const double mounted_height_m = T_robot_camera.translation().z();
  if (!(mounted_height_m >= kHeightMin_m && mounted_height_m <= kHeightMax_m)) return std::nullopt;
  const double quanta_m = table.quanta_m();
  const Eigen::Vector3d mounted_down = -T_robot_camera.linear().row(2).transpose();
  const Eigen::Vector3d mounted = quanta_m / mounted_height_m * mounted_down;
  const double prior = 1.0 / (kPriorSigma_ratio * kPriorSigma_ratio * mounted.squaredNorm());
  const FloorView as_mounted{mounted_down, mounted_height_m, 0};

  const auto rows = static_cast<std::size_t>(rows_of(depth.width_px, depth.height_px).count);
  quanta_.resize(rows * static_cast<std::size_t>(columns_of(depth.width_px).count));
  is_looked_up_.assign(rows, 0);

  Eigen::Vector3d gradient = mounted;
  int points = 0;
  for (const double band_m : kBands_m) {
    const double height_m = quanta_m / gradient.norm();
    Round round = gather_near(depth, camera, table, gradient, band_m / height_m);
    if (round.points < kPointsFewest) return as_mounted;
    round.normal.diagonal().array() += prior;
    round.right += prior * (mounted - gradient);
    gradient += round.normal.ldlt().solve(round.right);
    points = static_cast<int>(round.points);
    if (!gradient.allFinite() || gradient.norm() < 1e-6) return as_mounted;
  }
  const Eigen::Vector3d down = gradient.normalized();
  if (down.dot(mounted_down) < kCosTurnMax) return as_mounted;
  return FloorView{down, quanta_m / gradient.norm(), points};
}

}  // namespace roomwise::landmark
