#include "services/landmark_svc/core/round_profile.h"

#include <Eigen/LU>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr double kRadiusMin_m = 0.005;
constexpr double kRadiusMax_m = 3.0;

/// Sums of one Gauss-Newton step in (s, r).
struct Step {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double squares_m2 = 0.0;
};

Step sums_about(std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& along,
                const Eigen::Vector2d& across, double s_m, double radius_m) {
  Step step;
  const Eigen::Vector2d center = s_m * along + radius_m * across;
  for (const Eigen::Vector2d& p : points_m) {
    const Eigen::Vector2d from = p - center;
    const double distance = std::max(from.norm(), 1e-9);
    const double error = distance - radius_m;
    const Eigen::Vector2d unit = from / distance;
    const Eigen::Vector2d jacobian(-unit.dot(along), -unit.dot(across) - 1.0);
    step.normal += jacobian * jacobian.transpose();
    step.right -= error * jacobian;
    step.squares_m2 += error * error;
  }
  return step;
}

}  // namespace

std::optional<TangentCircle> fit_tangent_circle(std::span<const Eigen::Vector2d> points_m,
                                                const Eigen::Vector2d& edge_ray, bool inward_left) {
  constexpr std::size_t kFewest = 5;
  constexpr int kSteps = 6;
  if (points_m.size() < kFewest || !(edge_ray.norm() > 0.0)) return std::nullopt;
  const Eigen::Vector2d along = edge_ray.normalized();
  const Eigen::Vector2d left(-along.y(), along.x());
  const Eigen::Vector2d across = inward_left ? left : Eigen::Vector2d(-left);
  std::optional<TangentCircle> best;
  for (const double start_m : {0.03, 0.12, 0.40}) {
    double radius_m = start_m;
    double s_m = points_m.back().dot(along) + start_m;
    for (int i = 0; i < kSteps; ++i) {
      Step step = sums_about(points_m, along, across, s_m, radius_m);
      step.normal.diagonal().array() += 1e-6;
      const Eigen::Vector2d change = step.normal.inverse() * step.right;
      s_m += change.x();
      radius_m = std::max(kRadiusMin_m, radius_m + change.y());
    }
    if (!(radius_m > kRadiusMin_m && radius_m < kRadiusMax_m) || !std::isfinite(s_m)) continue;
    const double squares_m2 = sums_about(points_m, along, across, s_m, radius_m).squares_m2;
    const double rms_m = std::sqrt(squares_m2 / static_cast<double>(points_m.size()));
    if (!best || rms_m < best->rms_m) {
      best = TangentCircle{s_m * along + radius_m * across, radius_m, rms_m};
    }
  }
  return best;
}

double line_rms_m(std::span<const Eigen::Vector2d> points_m) {
  if (points_m.size() < 2) return 0.0;
  const auto n = static_cast<double>(points_m.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points_m) mean += p / n;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points_m) spread += (p - mean) * (p - mean).transpose() / n;
  const double half = 0.5 * (spread(0, 0) - spread(1, 1));
  const double across = 0.5 * spread.trace() - std::hypot(half, spread(0, 1));
  return std::sqrt(std::max(0.0, across));
}

}  // namespace roomwise::landmark
