#include "tests/simulator/support/disparity_statistics.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace roomwise::simulator {
namespace {

constexpr int kSide_px = 24;
constexpr double kFlat_quanta = 4.0;

/// Residuals of one window about its plane, NaN in holes.
struct Window {
  std::vector<double> residual = std::vector<double>(kSide_px * kSide_px);

  double at(int x, int y) const { return residual[static_cast<std::size_t>(y * kSide_px + x)]; }
  double mean_product(int dx, int dy) const {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y + dy < kSide_px; ++y) {
      for (int x = 0; x + dx < kSide_px; ++x) {
        const double product = at(x, y) * at(x + dx, y + dy);
        if (!std::isnan(product)) sum += product, ++count;
      }
    }
    return sum / std::max(count, 1);
  }
  double mean_squared_second_difference() const {
    constexpr int kShift_px = 8;
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < kSide_px; ++y) {
      for (int x = kShift_px; x + kShift_px < kSide_px; ++x) {
        const double d = at(x - kShift_px, y) - 2.0 * at(x, y) + at(x + kShift_px, y);
        if (!std::isnan(d)) sum += d * d, ++count;
      }
    }
    return sum / std::max(count, 1);
  }
};

/// False unless the window at (u0, v0) is flat and has few holes.
bool fit(const DisparityImage& image, int u0, int v0, Window& window) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const double quanta = image.at(u0 + x, v0 + y);
      if (quanta <= 0.0) continue;
      const Eigen::Vector3d row(1.0, x, y);
      normal += row * row.transpose();
      right += quanta * row;
    }
  }
  if (normal(0, 0) < 0.98 * kSide_px * kSide_px) return false;
  const Eigen::Vector3d plane = normal.inverse() * right;
  bool is_flat = true;
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const double quanta = image.at(u0 + x, v0 + y);
      double& residual = window.residual[static_cast<std::size_t>(y * kSide_px + x)];
      residual = quanta > 0.0 ? quanta - plane.dot(Eigen::Vector3d(1.0, x, y))
                              : std::numeric_limits<double>::quiet_NaN();
      is_flat = is_flat && !(std::abs(residual) >= kFlat_quanta);
    }
  }
  return is_flat;
}

void add(const Window& window, PlaneScatter& sum) {
  const double variance = window.mean_product(0, 0);
  ++sum.windows;
  sum.sigma_quanta += std::sqrt(variance);
  sum.second_difference_quanta += window.mean_squared_second_difference();
  for (int lag = 0; lag < PlaneScatter::kLags; ++lag) {
    const auto i = static_cast<std::size_t>(lag);
    sum.across[i] += window.mean_product(lag, 0) / variance;
    sum.down[i] += window.mean_product(0, lag) / variance;
  }
}

}  // namespace

PlaneScatter plane_scatter(const std::vector<DisparityImage>& images) {
  PlaneScatter result;
  Window window;
  for (const DisparityImage& image : images) {
    for (int v = 0; v + kSide_px <= image.height_px; v += kSide_px / 2) {
      for (int u = 0; u + kSide_px <= image.width_px; u += kSide_px / 2) {
        if (fit(image, u, v, window)) add(window, result);
      }
    }
  }
  const double windows = std::max(result.windows, 1);
  result.sigma_quanta /= windows;
  result.second_difference_quanta = std::sqrt(result.second_difference_quanta / windows);
  for (double& value : result.across) value /= windows;
  for (double& value : result.down) value /= windows;
  return result;
}

double frame_difference_quanta(const std::vector<DisparityImage>& images) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 1; i < images.size(); ++i) {
    for (std::size_t k = 0; k < images[i].quanta.size(); ++k) {
      const double before = images[i - 1].quanta[k], after = images[i].quanta[k];
      if (before <= 0.0 || after <= 0.0 || std::abs(after - before) >= 6.0) continue;
      sum += (after - before) * (after - before);
      ++count;
    }
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

}  // namespace roomwise::simulator
