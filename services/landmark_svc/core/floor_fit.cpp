#include "services/landmark_svc/core/floor_fit.h"

#include <Eigen/Cholesky>
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

/// Normal equations of one round.
struct Round {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int points = 0;
};

Round gather_near(const DepthImage& depth, const PinholeCamera& camera, const DisparityTable& table,
                  const Eigen::Vector3d& gradient, double band_ratio) {
  Round round;
  const int stride = std::max(1, depth.width_px / kColumns);
  for (int v = stride / 2; v < depth.height_px; v += stride) {
    for (int u = stride / 2; u < depth.width_px; u += stride) {
      const double quanta =
          static_cast<double>(table.parts(depth.at(u, v))) / DisparityTable::kPartsPerQuantum;
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px,
                                (v - camera.cy_px) / camera.fy_px, 1.0);
      const double off = quanta - gradient.dot(ray);
      if (quanta <= 0.0 || std::abs(off) > band_ratio * quanta + kNoise_quanta) continue;
      round.normal += ray * ray.transpose();
      round.right += off * ray;
      ++round.points;
    }
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
    points = round.points;
    if (!gradient.allFinite() || gradient.norm() < 1e-6) return as_mounted;
  }
  const Eigen::Vector3d down = gradient.normalized();
  if (down.dot(mounted_down) < kCosTurnMax) return as_mounted;
  return FloorView{down, quanta_m / gradient.norm(), points};
}

}  // namespace roomwise::landmark
