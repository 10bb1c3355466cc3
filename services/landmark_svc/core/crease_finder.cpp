#include "services/landmark_svc/core/crease_finder.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr double kShorter = 0.7;     // what is not straight is tried by so much shorter
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

/// Sine of the angle between two planes, signed.
double sine_between(const ScanLine& one, const ScanLine& two) {
  const Eigen::Vector2d a = one.normal().normalized();
  const Eigen::Vector2d b = two.normal().normalized();
  return a.x() * b.y() - a.y() * b.x();
}

/// Where both planes are: along and left of the camera.
Eigen::Vector2d crossing_m(const ScanLine& one, const ScanLine& two, double quanta_m) {
  const double ratio = (one.quanta - two.quanta) / (two.slope - one.slope);
  const double along_m = quanta_m / (one.quanta + one.slope * ratio);
  return {along_m, along_m * ratio};
}

/// Of what one line tells of the crossing, per m^2.
Eigen::Matrix2d information_of(const ScanLine& line, const Eigen::Vector2d& p_m, double quantum_m,
                               double sigma_quanta, double bias_m) {
  const double ratio = p_m.y() / p_m.x();
  const Eigen::Vector2d normal = line.normal().normalized();
  // A quantum moves the point along its ray.
  const double per_quantum_m = quantum_m * std::abs(normal.dot(Eigen::Vector2d(1.0, ratio)));
  const double variance_m2 =
      per_quantum_m * per_quantum_m * line.variance_at(ratio, sigma_quanta) + bias_m * bias_m;
  return normal * normal.transpose() / variance_m2;
}

}  // namespace

void CreaseFinder::reserve(std::size_t points) {
  lines_.reserve(points);
  candidates_.reserve(points);
}

std::optional<CreaseFinder::Side> CreaseFinder::side_of(std::size_t at, int step,
                                                        double residual_max_quanta,
                                                        const CreaseParams& params,
                                                        RejectCounts& rejected) {
  constexpr std::size_t kFewest = 4;
  bool is_long_enough = false;
  std::size_t& longest = longest_end_[step < 0 ? 0 : 1];
  longest = lines_.reach(at, step, params.side_max_m, longest);
  std::size_t end = longest;
  for (double length_m = params.side_max_m; length_m >= params.side_min_m; length_m *= kShorter) {
    end = lines_.reach(at, step, length_m, end);
    const std::size_t columns = step < 0 ? at - end : end - at;
    if (columns < kFewest + kSkipped) break;
    if ((lines_.p_m(end) - lines_.p_m(at)).norm() < params.side_min_m) break;
    is_long_enough = true;
    const ScanLine line =
        step < 0 ? lines_.line(end, at - kSkipped + 1) : lines_.line(at + kSkipped, end + 1);
    if (line.rms_quanta <= residual_max_quanta) return Side{end, line};
  }
  if (is_long_enough) rejected.add(RejectReason::kCreaseNotStraight);
  return std::nullopt;
}

bool CreaseFinder::judge(const VirtualScan& scan, std::size_t at, const DisparityTable& table,
                         const CreaseParams& params, Candidate& candidate, RejectCounts& rejected) {
  const double quantum_m = table.quantum_m(scan.points()[at].along_m);
  const double residual_max_quanta =
      std::hypot(params.residual_max_quanta, params.residual_max_m / quantum_m);
  const auto one = side_of(at, -1, residual_max_quanta, params, rejected);
  if (!one) return false;
  const auto two = side_of(at, 1, residual_max_quanta, params, rejected);
  if (!two) return false;
  if (std::abs(sine_between(one->line, two->line)) < std::sin(params.angle_min_rad)) return false;
  const double bend = two->line.slope - one->line.slope;
  const double bend_variance = one->line.slope_variance(params.residual_max_quanta) +
                               two->line.slope_variance(params.residual_max_quanta);
  if (bend * bend < params.bend_min_sigmas * params.bend_min_sigmas * bend_variance) return false;
  const Eigen::Vector2d p_m = crossing_m(one->line, two->line, table.quanta_m());
  if (!((p_m - lines_.p_m(at)).norm() <= params.off_scan_max_m)) {
    rejected.add(RejectReason::kCreaseOffScan);
    return false;
  }
  candidate = {.at = at,
               .first = one->end,
               .last = two->end,
               .one = one->line,
               .two = two->line,
               .misfit_quanta = std::hypot(one->line.rms_quanta, two->line.rms_quanta),
               .p_m = p_m};
  return true;
}

bool CreaseFinder::is_round(const Candidate& candidate, const DisparityTable& table,
                            const CreaseParams& params) const {
  const auto squares_m2 = [&](const ScanLine& line, std::size_t begin, std::size_t end) {
    double sum_m2 = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double distance_m = line.distance_m(lines_.p_m(i), table.quanta_m());
      sum_m2 += distance_m * distance_m;
    }
    return sum_m2;
  };
  const double lines_m2 = squares_m2(candidate.one, candidate.first, candidate.at) +
                          squares_m2(candidate.two, candidate.at, candidate.last + 1);
  const double lines_rms_m =
      std::sqrt(lines_m2 / static_cast<double>(candidate.last - candidate.first + 1));
  const double circle_m = circle_rms_m(lines_, candidate.first, candidate.last);
  return circle_m < params.round_better_ratio * lines_rms_m;
}

void CreaseFinder::append(const Candidate& candidate, const VirtualScan& scan,
                          const FloorView& floor, const PinholeCamera& camera,
                          const DisparityTable& table, const CreaseParams& params,
                          std::vector<Landmark>& landmarks) const {
  const double quantum_m = table.quantum_m(candidate.p_m.x());
  const auto information = [&](const ScanLine& line) {
    const double sigma_quanta = std::max(line.rms_quanta, params.residual_max_quanta);
    return information_of(line, candidate.p_m, quantum_m, sigma_quanta, params.position_bias_m);
  };
  Eigen::Matrix2d axes;  // along and left, robot frame
  axes << scan.forward(), Eigen::Vector2d(-scan.forward().y(), scan.forward().x());
  const Eigen::Matrix2d covariance_m2 =
      axes * (information(candidate.one) + information(candidate.two)).inverse() * axes.transpose();
  const Eigen::Vector2d p_robot_m = scan.origin_m() + axes * candidate.p_m;
  if (!p_robot_m.allFinite() || !covariance_m2.allFinite()) return;
  const Eigen::Vector2d chord_m = 0.5 * (lines_.p_m(candidate.first) + lines_.p_m(candidate.last));
  const bool is_convex = (candidate.p_m - chord_m).dot(candidate.p_m) < 0.0;
  const ScanPoint& point = scan.points()[candidate.at];
  Landmark& landmark = landmarks.emplace_back();
  landmark.kind = is_convex ? LandmarkKind::kCreaseConvex : LandmarkKind::kCreaseConcave;
  set_position(landmark, p_robot_m, covariance_m2);
  landmark.rows = point.rows;
  landmark.u_px = point.u_px;
  landmark.v_top_px = point.v_top_px;
  landmark.v_bottom_px = point.v_bottom_px;
  landmark.height_low_m = height_above_floor_m(floor, camera, point.v_bottom_px, point.along_m);
  landmark.height_high_m = height_above_floor_m(floor, camera, point.v_top_px, point.along_m);
  const double rows = point.rows;
  landmark.score_ratio =
      rows / (rows + 9.0) * std::abs(sine_between(candidate.one, candidate.two)) *
      params.residual_max_quanta / (params.residual_max_quanta + candidate.misfit_quanta);
}

void CreaseFinder::find(const VirtualScan& scan, const FloorView& floor,
                        const PinholeCamera& camera, const DisparityTable& table, int width_px,
                        const CreaseParams& params, std::vector<Landmark>& landmarks,
                        RejectCounts& rejected) {
  const auto& points = scan.points();
  candidates_.clear();
  longest_end_ = {};
  lines_.prepare(scan, table);
  const double suppress_px = params.suppress_px * width_px / 640.0;
  for (std::size_t at = 0; at < points.size(); ++at) {
    Candidate candidate;
    if (!judge(scan, at, table, params, candidate, rejected)) continue;
    if (!candidates_.empty() &&
        points[at].u_px - points[candidates_.back().at].u_px <= suppress_px) {
      if (candidate.misfit_quanta < candidates_.back().misfit_quanta) {
        candidates_.back() = candidate;
      }
      continue;
    }
    candidates_.push_back(candidate);
  }
  for (const Candidate& candidate : candidates_) {
    if (is_round(candidate, table, params)) {
      rejected.add(RejectReason::kCreaseOnRound);
    } else {
      append(candidate, scan, floor, camera, table, params, landmarks);
    }
  }
}

}  // namespace roomwise::landmark
