#include "logs/tools/covariance_ellipse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise {

std::vector<Eigen::Vector2d> ellipse_outline(const Eigen::Vector2d& mean_m,
                                             const Eigen::Matrix2d& covariance_m2) {
  constexpr int kPoints = 72;
  const double kRadius = std::sqrt(5.991);
  const double xx = covariance_m2(0, 0);
  const double xy = covariance_m2(0, 1);
  const double yy = covariance_m2(1, 1);
  if (!(xx >= 0.0) || !(yy >= 0.0) || !(xx * yy >= xy * xy)) return {};
  // Cholesky by hand: L = [a 0; b c], and a flat ellipse has a or c = 0.
  const double a = std::sqrt(xx);
  const double b = a > 0.0 ? xy / a : 0.0;
  const double c = std::sqrt(std::max(0.0, yy - b * b));
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kPoints; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kPoints;
    const double u = kRadius * std::cos(angle_rad);
    const double v = kRadius * std::sin(angle_rad);
    outline.emplace_back(mean_m.x() + a * u, mean_m.y() + b * u + c * v);
  }
  return outline;
}

}  // namespace roomwise
