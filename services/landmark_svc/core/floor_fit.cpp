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
constexpr int kColumns = 107;  // every 6th of 640
constexpr int kPointsFewest = 80;
constexpr double kPriorSigma_ratio = 0.05;
constexpr double kCosTurnMax = 0.966;  // 15 degrees
constexpr std::array<double, 3> kBands_m = {0.10, 0.05, 0.03};
constexpr double kNoise_quanta = 2.0;

constexpr int kColumnsMax = 2 * kColumns;
using GridRow = Eigen::Array<float, Eigen::Dynamic, 1, 0, kColumnsMax, 1>;  // on the stack

/// Normal equations of one round.
struct Round {
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

/// Only the lower triangle of the normal equations is filled.
Round gather_near(const DepthImage& depth, const PinholeCamera& camera, const DisparityTable& table,
                  const Eigen::Vector3d& gradient, double band_ratio) {
  Round round;
  const int stride = std::max(1, depth.width_px / kColumns);
  const int first = stride / 2;
  const int columns = (depth.width_px - first + stride - 1) / stride;
  GridRow x(columns);
  for (int k = 0; k < columns; ++k) {
    x[k] = static_cast<float>((first + k * stride - camera.cx_px) / camera.fx_px);
  }
  const auto band = static_cast<float>(band_ratio);
  constexpr auto kNoise = static_cast<float>(kNoise_quanta);
  GridRow quanta(columns);
  GridRow off(columns);
  GridRow counts(columns);
  for (int v = first; v < depth.height_px; v += stride) {
    const double y = (v - camera.cy_px) / camera.fy_px;
    for (int k = 0; k < columns; ++k) {
      quanta[k] = static_cast<float>(table.parts(depth.at(first + k * stride, v)));
    }
    quanta /= static_cast<float>(DisparityTable::kPartsPerQuantum);
    const auto of_row = static_cast<float>(gradient.y() * y + gradient.z());
    off = quanta - of_row - static_cast<float>(gradient.x()) * x;
    counts = (quanta > 0.0F && off.abs() <= band * quanta + kNoise).cast<float>();
    round.add(counts, x, off, y);
  }
  return round;
}

}  // namespace

std::optional<FloorView> fit_floor(const DepthImage& depth, const PinholeCamera& camera,
                                   const DisparityTable& table,
                                   const Eigen::Isometry3d& T_robot_camera) {
  const double mounted_height_m = T_robot_camera.translation().z();
  if (!(mounted_height_m >= kHeightMin_m && mounted_height_m <= kHeightMax_m)) return std::nullopt;
  const double quanta_m = table.quanta_m();
  const Eigen::Vector3d mounted_down = -T_robot_camera.linear().row(2).transpose();
  const Eigen::Vector3d mounted = quanta_m / mounted_height_m * mounted_down;
  const double prior = 1.0 / (kPriorSigma_ratio * kPriorSigma_ratio * mounted.squaredNorm());
  const FloorView as_mounted{mounted_down, mounted_height_m, 0};

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
