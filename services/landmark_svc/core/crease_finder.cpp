#include "services/landmark_svc/core/crease_finder.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise::landmark {
namespace {

constexpr std::size_t kSkipped = 1;  // points beside the crease that may show both sides

double height_above_floor_m(const FloorView& floor, const PinholeCamera& camera, double v_px,
                            double along_m) {
  // The level camera's view of the column: good to a centimetre for small rolls.
  const Eigen::Vector3d ray(0.0, (v_px - camera.cy_px) / camera.fy_px, 1.0);
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d level =
      (ahead - ahead.dot(floor.down_camera) * floor.down_camera).normalized();
  return floor.height_m - along_m * floor.down_camera.dot(ray) / std::max(level.dot(ray), 0.1);
}

}  // namespace

void CreaseFinder::reserve(std::size_t points) {
  sums_.reserve(points + 1);
  piece_.reserve(points);
  candidates_.reserve(points);
}

void CreaseFinder::prepare(const std::vector<ScanPoint>& points, const DisparityTable& table) {
  sums_.assign(1, Sums{});
  piece_.clear();
  std::uint32_t piece = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p = points[i].p_robot_m - points[0].p_robot_m;
    const Sums& s = sums_.back();
    sums_.push_back({s.n + 1.0, s.x + p.x(), s.y + p.y(), s.xx + p.x() * p.x(),
                     s.xy + p.x() * p.y(), s.yy + p.y() * p.y()});
    if (i > 0) {
      const double step_m = std::abs(points[i].along_m - points[i - 1].along_m);
      const double most_m = std::max(0.06, 3.0 * table.quantum_m(points[i].along_m));
      if (step_m > most_m || points[i].u_px - points[i - 1].u_px > 4) ++piece;
    }
    piece_.push_back(piece);
  }
}

CreaseFinder::Line CreaseFinder::line_of(std::size_t begin, std::size_t end) const {
  const Sums& a = sums_[begin];
  const Sums& b = sums_[end];
  const double n = b.n - a.n;
  const double x = (b.x - a.x) / n;
  const double y = (b.y - a.y) / n;
  const double xx = (b.xx - a.xx) / n - x * x;
  const double xy = (b.xy - a.xy) / n - x * y;
  const double yy = (b.yy - a.yy) / n - y * y;
  // Principal axis of the 2 x 2 covariance, in closed form.
  const double half = 0.5 * (xx - yy);
  const double root = std::hypot(half, xy);
  const double angle = 0.5 * std::atan2(xy, half);
  const double across = std::max(0.0, 0.5 * (xx + yy) - root);
  return {{x, y}, {std::cos(angle), std::sin(angle)}, std::sqrt(across), n};
}

/// By how much the second half of a side turns from the first, counter-clockwise.
double CreaseFinder::bend_rad(std::size_t begin, std::size_t end) const {
  const std::size_t middle = begin + (end - begin) / 2;
  const Line one = line_of(begin, middle);
  const Line two = line_of(middle, end);
  const double sine = one.along.x() * two.along.y() - one.along.y() * two.along.x();
  const double cosine = one.along.dot(two.along);
  return std::atan(sine / (std::abs(cosine) > 1e-9 ? cosine : 1e-9));
}

std::size_t CreaseFinder::reach(const std::vector<ScanPoint>& points, std::size_t from, int step,
                                double length_m) const {
  std::size_t at = from;
  while (true) {
    if (step < 0 ? at == 0 : at + 1 == points.size()) return at;
    const std::size_t next = step < 0 ? at - 1 : at + 1;
    if (piece_[next] != piece_[from]) return at;
    if ((points[next].p_robot_m - points[from].p_robot_m).squaredNorm() > length_m * length_m) {
      return at;
    }
    at = next;
  }
}

bool CreaseFinder::judge(const VirtualScan& scan, std::size_t at, const DisparityTable& table,
                         const CreaseParams& params, Candidate& candidate,
                         RejectCounts& rejected) const {
  const auto& points = scan.points();
  const std::size_t first = reach(points, at, -1, params.side_max_m);
  const std::size_t last = reach(points, at, 1, params.side_max_m);
  constexpr std::size_t kFewest = 5;
  if (at - first < kFewest + kSkipped || last - at < kFewest + kSkipped) return false;
  const auto length_m = [&](std::size_t end) {
    return (points[end].p_robot_m - points[at].p_robot_m).norm();
  };
  if (length_m(first) < params.side_min_m || length_m(last) < params.side_min_m) return false;
  const Line one = line_of(first, at - kSkipped + 1);
  const Line two = line_of(at + kSkipped, last + 1);
  const double sine = one.along.x() * two.along.y() - one.along.y() * two.along.x();
  if (std::abs(sine) < std::sin(params.angle_min_rad)) return false;
  const double quantum_m = table.quantum_m(points[at].along_m);
  if (std::max(one.rms_m, two.rms_m) > params.residual_max_m + 0.5 * quantum_m) {
    rejected.add(RejectReason::kCreaseNotStraight);
    return false;
  }
  const double turn_rad = std::atan(sine / one.along.dot(two.along));
  const double bends_rad = bend_rad(first, at - kSkipped + 1) + bend_rad(at + kSkipped, last + 1);
  const double same_way_rad = turn_rad < 0.0 ? -bends_rad : bends_rad;
  if (std::abs(turn_rad) < 1.2 && same_way_rad > 0.5 * std::abs(turn_rad)) {
    rejected.add(RejectReason::kCreaseOnRound);
    return false;
  }
  const Eigen::Vector2d between = two.mean_m - one.mean_m;
  const double t = (between.x() * two.along.y() - between.y() * two.along.x()) / sine;
  const Eigen::Vector2d crossing = one.mean_m + t * one.along;
  const Eigen::Vector2d p_m = crossing + points[0].p_robot_m;
  if ((p_m - points[at].p_robot_m).norm() > params.off_scan_max_m) {
    rejected.add(RejectReason::kCreaseOffScan);
    return false;
  }
  const Eigen::Vector2d chord = 0.5 * (one.mean_m + two.mean_m);
  const auto sigma = [&](const Line& line) {
    return std::hypot(
        std::hypot(line.rms_m, 0.3 * quantum_m) / std::sqrt(std::min(line.points, 9.0)),
        params.position_bias_m);
  };
  const Eigen::Vector2d n1(-one.along.y(), one.along.x());
  const Eigen::Vector2d n2(-two.along.y(), two.along.x());
  const Eigen::Matrix2d information = n1 * n1.transpose() / (sigma(one) * sigma(one)) +
                                      n2 * n2.transpose() / (sigma(two) * sigma(two));
  candidate = {.at = at,
               .misfit_m = std::hypot(one.rms_m, two.rms_m),
               .is_convex = (crossing - chord).dot(p_m - scan.origin_m()) < 0.0,
               .p_robot_m = p_m,
               .covariance_m2 = information.inverse(),
               .angle_rad = std::asin(std::min(1.0, std::abs(sine))),
               .first = first,
               .last = last};
  return p_m.allFinite() && candidate.covariance_m2.allFinite();
}

void CreaseFinder::find(const VirtualScan& scan, const FloorView& floor,
                        const PinholeCamera& camera, const DisparityTable& table, int width_px,
                        const CreaseParams& params, std::vector<Landmark>& landmarks,
                        RejectCounts& rejected) {
  const auto& points = scan.points();
  candidates_.clear();
  if (points.empty()) return;
  prepare(points, table);
  const double suppress_px = params.suppress_px * width_px / 640.0;
  for (std::size_t at = 0; at < points.size(); ++at) {
    Candidate candidate;
    if (!judge(scan, at, table, params, candidate, rejected)) continue;
    if (!candidates_.empty() &&
        points[at].u_px - points[candidates_.back().at].u_px <= suppress_px) {
      if (candidate.misfit_m < candidates_.back().misfit_m) candidates_.back() = candidate;
      continue;
    }
    candidates_.push_back(candidate);
  }
  for (const Candidate& c : candidates_) {
    Landmark& landmark = landmarks.emplace_back();
    const ScanPoint& point = points[c.at];
    landmark.kind = c.is_convex ? LandmarkKind::kCreaseConvex : LandmarkKind::kCreaseConcave;
    set_position(landmark, c.p_robot_m, c.covariance_m2);
    landmark.rows = point.rows;
    landmark.u_px = point.u_px;
    landmark.v_top_px = point.v_top_px;
    landmark.v_bottom_px = point.v_bottom_px;
    landmark.height_low_m = height_above_floor_m(floor, camera, point.v_bottom_px, point.along_m);
    landmark.height_high_m = height_above_floor_m(floor, camera, point.v_top_px, point.along_m);
    const double rows = point.rows;
    landmark.score_ratio = rows / (rows + 9.0) * std::sin(c.angle_rad) * params.residual_max_m /
                           (params.residual_max_m + c.misfit_m);
  }
}

}  // namespace roomwise::landmark
