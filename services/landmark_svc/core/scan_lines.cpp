#include "services/landmark_svc/core/scan_lines.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace roomwise::landmark {
namespace {

constexpr double kIndependent = 9.0;

/// Centre and radius of a circle that is to be improved.
struct Circle {
  Eigen::Vector2d center_m;
  double radius_m;
};

/// Kasa's algebraic fit: linear, so a start from anywhere.
Circle rough_circle(const ScanLines& scan, std::size_t first, std::size_t last,
                    const Eigen::Vector2d& about_m) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    const Eigen::Vector2d p = scan.p_m(i) - about_m;
    const Eigen::Vector3d row(p.x(), p.y(), 1.0);
    normal += row * row.transpose();
    right += p.squaredNorm() * row;
  }
  const Eigen::Vector3d solved = normal.inverse() * right;
  const Eigen::Vector2d center = 0.5 * solved.head<2>();
  return {about_m + center, std::sqrt(std::max(0.0, solved.z() + center.squaredNorm()))};
}

/// One Gauss-Newton step for the distances to the circle; returns their mean square before it.
double improve(const ScanLines& scan, std::size_t first, std::size_t last, Circle& circle) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares_m2 = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Eigen::Vector2d from = scan.p_m(i) - circle.center_m;
    const double distance_m = std::max(from.norm(), 1e-9);
    const double error_m = distance_m - circle.radius_m;
    const Eigen::Vector3d row(from.x() / distance_m, from.y() / distance_m, 1.0);
    normal += row * row.transpose();
    right += error_m * row;
    squares_m2 += error_m * error_m;
  }
  normal.diagonal().array() += 1e-9;
  const Eigen::Vector3d change = normal.inverse() * right;
  circle.center_m += change.head<2>();
  circle.radius_m += change.z();
  return squares_m2 / static_cast<double>(last - first + 1);
}

}  // namespace

double ScanLine::slope_variance(double sigma_quanta) const {
  return sigma_quanta * sigma_quanta / (std::min(points, kIndependent) * variance_ratio2);
}

double ScanLine::variance_at(double ratio, double sigma_quanta) const {
  const double away = ratio - mean_ratio;
  return sigma_quanta * sigma_quanta / std::min(points, kIndependent) +
         away * away * slope_variance(sigma_quanta);
}

void ScanLines::reserve(std::size_t points) {
  sums_.reserve(points + 1);
  points_m_.reserve(points);
  piece_.reserve(points);
}

void ScanLines::prepare(const VirtualScan& scan, const DisparityTable& table) {
  sums_.assign(1, Sums{});
  points_m_.clear();
  piece_.clear();
  const auto& points = scan.points();
  const Eigen::Vector2d left(-scan.forward().y(), scan.forward().x());
  std::uint32_t piece = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along_m = points[i].along_m;
    points_m_.emplace_back(along_m, left.dot(points[i].p_robot_m - scan.origin_m()));
    const double x = points_m_.back().y() / along_m;
    const double d = table.quanta_m() / along_m;
    const Sums& s = sums_.back();
    sums_.push_back({s.n + 1.0, s.x + x, s.d + d, s.xx + x * x, s.xd + x * d, s.dd + d * d});
    if (i > 0) {
      const double step_m = std::abs(along_m - points[i - 1].along_m);
      const double most_m = std::max(0.06, 3.0 * table.quantum_m(along_m));
      if (step_m > most_m || points[i].u_px - points[i - 1].u_px > 4) ++piece;
    }
    piece_.push_back(piece);
  }
}

ScanLine ScanLines::line(std::size_t begin, std::size_t end) const {
  const Sums& a = sums_[begin];
  const Sums& b = sums_[end];
  ScanLine line;
  line.points = b.n - a.n;
  const double x = (b.x - a.x) / line.points;
  const double d = (b.d - a.d) / line.points;
  line.mean_ratio = x;
  line.variance_ratio2 = std::max(1e-12, (b.xx - a.xx) / line.points - x * x);
  const double xd = (b.xd - a.xd) / line.points - x * d;
  const double dd = (b.dd - a.dd) / line.points - d * d;
  line.slope = xd / line.variance_ratio2;
  line.quanta = d - line.slope * x;
  line.rms_quanta = std::sqrt(std::max(0.0, dd - line.slope * xd));
  return line;
}

std::size_t ScanLines::reach(std::size_t from, int step, double length_m, std::size_t about) const {
  const auto is_within = [&](std::size_t at) {
    return (points_m_[at] - points_m_[from]).squaredNorm() <= length_m * length_m;
  };
  const bool is_ahead = step < 0 ? about < from : about > from && about < points_m_.size();
  std::size_t at = is_ahead && piece_[about] == piece_[from] ? about : from;
  while (at != from && !is_within(at)) at = step < 0 ? at + 1 : at - 1;
  while (step < 0 ? at != 0 : at + 1 != points_m_.size()) {
    const std::size_t next = step < 0 ? at - 1 : at + 1;
    if (piece_[next] != piece_[from] || !is_within(next)) break;
    at = next;
  }
  return at;
}

double circle_rms_m(const ScanLines& scan, std::size_t first, std::size_t last) {
  constexpr std::size_t kFewest = 4;
  constexpr int kSteps = 4;
  if (last < first + kFewest - 1) return std::numeric_limits<double>::infinity();
  Circle circle = rough_circle(scan, first, last, scan.p_m((first + last) / 2));
  double mean_square_m2 = 0.0;
  for (int i = 0; i <= kSteps; ++i) mean_square_m2 = improve(scan, first, last, circle);
  return std::isfinite(mean_square_m2) ? std::sqrt(mean_square_m2)
                                       : std::numeric_limits<double>::infinity();
}

}  // namespace roomwise::landmark
