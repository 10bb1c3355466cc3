#include "services/landmark_svc/core/landmark_pieces.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/geometry/angle.h"

namespace roomwise::landmark {
namespace {

Eigen::Vector2d position_m(const Landmark& landmark) {
  return landmark.range_m *
         Eigen::Vector2d(std::cos(landmark.bearing_rad), std::sin(landmark.bearing_rad));
}

bool are_one_edge(const Landmark& a, const Landmark& b, double gate_mahalanobis_sq) {
  if (a.kind != b.kind) return false;
  const Eigen::Vector2d difference(a.range_m - b.range_m,
                                   wrap_angle(a.bearing_rad - b.bearing_rad));
  const Eigen::Matrix2d covariance = a.covariance + b.covariance;
  return difference.dot(covariance.inverse() * difference) < gate_mahalanobis_sq;
}

bool are_side_by_side(const Landmark& a, const Landmark& b) {
  return std::min(a.height_high_m, b.height_high_m) > std::max(a.height_low_m, b.height_low_m);
}

bool is_crease(const Landmark& landmark) {
  return landmark.kind == LandmarkKind::kCreaseConvex ||
         landmark.kind == LandmarkKind::kCreaseConcave;
}

Landmark average(const Landmark& a, const Landmark& b) {
  const Landmark& longer = a.rows >= b.rows ? a : b;
  const double b_share = static_cast<double>(b.rows) / (a.rows + b.rows);
  const auto mean = [b_share](double of_a, double of_b) { return of_a + b_share * (of_b - of_a); };
  Landmark joined = longer;  // covariance and colour of the piece that is known better
  const Eigen::Vector2d p_m = position_m(a) + b_share * (position_m(b) - position_m(a));
  joined.range_m = p_m.norm();
  joined.bearing_rad = wrap_angle(std::atan2(p_m.y(), p_m.x()));
  joined.height_low_m = std::min(a.height_low_m, b.height_low_m);
  joined.height_high_m = std::max(a.height_high_m, b.height_high_m);
  joined.step_m = mean(a.step_m, b.step_m);
  joined.score_ratio = std::max(a.score_ratio, b.score_ratio);
  joined.rows = a.rows + b.rows;
  joined.u_px = mean(a.u_px, b.u_px);
  joined.v_top_px = std::min(a.v_top_px, b.v_top_px);
  joined.v_bottom_px = std::max(a.v_bottom_px, b.v_bottom_px);
  return joined;
}

Landmark join(const Landmark& a, const Landmark& b) {
  if (are_side_by_side(a, b)) return a.score_ratio >= b.score_ratio ? a : b;
  return average(a, b);
}

}  // namespace

void join_pieces(std::vector<Landmark>& landmarks, double gate_mahalanobis_sq,
                 RejectCounts& rejected) {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (std::size_t j = i + 1; j < landmarks.size();) {
      if (!are_one_edge(landmarks[i], landmarks[j], gate_mahalanobis_sq)) {
        ++j;
        continue;
      }
      landmarks[i] = join(landmarks[i], landmarks[j]);
      landmarks.erase(landmarks.begin() + static_cast<std::ptrdiff_t>(j));
      rejected.add(RejectReason::kLandmarkMerged);
    }
  }
}

void drop_creases_at_edges(std::vector<Landmark>& landmarks, RejectCounts& rejected) {
  constexpr double kApart_m = 0.06;
  const auto is_at_edge = [&](const Landmark& crease) {
    return is_crease(crease) &&
           std::any_of(landmarks.begin(), landmarks.end(), [&](const Landmark& other) {
             return !is_crease(other) && (position_m(other) - position_m(crease)).norm() < kApart_m;
           });
  };
  for (std::size_t i = 0; i < landmarks.size();) {
    if (!is_at_edge(landmarks[i])) {
      ++i;
      continue;
    }
    landmarks.erase(landmarks.begin() + static_cast<std::ptrdiff_t>(i));
    rejected.add(RejectReason::kCreaseAtEdge);
  }
}

void keep_best(std::vector<Landmark>& landmarks, std::size_t most, RejectCounts& rejected) {
  std::sort(landmarks.begin(), landmarks.end(), [](const Landmark& a, const Landmark& b) {
    return std::tie(b.score_ratio, b.rows, a.u_px, a.v_top_px) <
           std::tie(a.score_ratio, a.rows, b.u_px, b.v_top_px);
  });
  while (landmarks.size() > most) {
    landmarks.pop_back();
    rejected.add(RejectReason::kLandmarkOverBudget);
  }
  std::sort(landmarks.begin(), landmarks.end(), [](const Landmark& a, const Landmark& b) {
    return std::tie(b.bearing_rad, a.range_m, a.kind, a.v_top_px) <
           std::tie(a.bearing_rad, b.range_m, b.kind, b.v_top_px);
  });
}

}  // namespace roomwise::landmark
