#include "logs/tools/alignment.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace roomwise {
namespace {

Eigen::Vector2d mean_of(const Points2& points) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d(Eigen::Vector2d::Zero()));
  return sum / static_cast<double>(points.size());
}

void require_pairs(const Points2& a, const Points2& b) {
  if (a.empty() || a.size() != b.size()) throw std::logic_error("points must come in pairs");
}

}  // namespace

Pose2 align_rigidly(const Points2& p_a_m, const Points2& p_b_m) {
  require_pairs(p_a_m, p_b_m);
  const Eigen::Vector2d mean_a = mean_of(p_a_m);
  const Eigen::Vector2d mean_b = mean_of(p_b_m);
  double dot = 0.0;
  double cross = 0.0;
  for (std::size_t i = 0; i < p_a_m.size(); ++i) {
    const Eigen::Vector2d a = p_a_m[i] - mean_a;
    const Eigen::Vector2d b = p_b_m[i] - mean_b;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
  }
  const double heading_rad = std::atan2(cross, dot);
  const Eigen::Vector2d p = mean_b - rotation2(heading_rad) * mean_a;
  return {p.x(), p.y(), wrap_angle(heading_rad)};
}

double rms_distance_m(const Pose2& T_b_a, const Points2& p_a_m, const Points2& p_b_m) {
  require_pairs(p_a_m, p_b_m);
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < p_a_m.size(); ++i) {
    sum_m2 += (p_b_m[i] - transform(T_b_a, p_a_m[i])).squaredNorm();
  }
  return std::sqrt(sum_m2 / static_cast<double>(p_a_m.size()));
}

}  // namespace roomwise
