#include "services/landmark_svc/core/thin_things.h"

#include <algorithm>
#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise::landmark {
namespace {

Eigen::Vector2d place_m(const Landmark& landmark) {
  return landmark.range_m *
         Eigen::Vector2d(std::cos(landmark.bearing_rad), std::sin(landmark.bearing_rad));
}

struct Rows {
  int first;
  int last;
  int count() const { return last - first + 1; }
};

Rows shared_rows(const Landmark& a, const Landmark& b) {
  return {static_cast<int>(std::lround(std::max(a.v_top_px, b.v_top_px))),
          static_cast<int>(std::lround(std::min(a.v_bottom_px, b.v_bottom_px)))};
}

double column_at(const Landmark& edge, double v_px) {
  return edge.u_px + edge.column_slope * (v_px - 0.5 * (edge.v_top_px + edge.v_bottom_px));
}

/// Share of readings between the edges that are of the same thing.
double filled_ratio(const Landmark& left, const Landmark& right, const Rows& rows,
                    const DepthImage& depth, const DisparityTable& table, double width_max_m) {
  int all = 0;
  int near = 0;
  const double most_m = 0.5 * (left.depth_m + right.depth_m) + width_max_m;
  const double least_m = 0.5 * (left.depth_m + right.depth_m) - width_max_m;
  const int stride = std::max(1, rows.count() / 16);
  for (int v = rows.first; v <= rows.last; v += stride) {
    const int begin = static_cast<int>(std::lround(column_at(left, v) + 0.5));
    const int end = static_cast<int>(std::lround(column_at(right, v) - 0.5));
    for (int u = std::max(0, begin); u <= std::min(end, depth.width_px - 1); ++u) {
      const std::uint16_t step = depth.at(u, v);
      const double z_m = table.depth_m(step);
      ++all;
      near += table.is_good(step) && z_m > least_m && z_m < most_m ? 1 : 0;
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(near) / all;
}

bool are_of_one_thing(const Landmark& left, const Landmark& right, const DepthImage& depth,
                      const DisparityTable& table, double width_max_m) {
  if (left.kind != LandmarkKind::kEdgeLeft || right.kind != LandmarkKind::kEdgeRight) return false;
  if (right.u_px <= left.u_px) return false;
  if ((place_m(left) - place_m(right)).norm() >= width_max_m) return false;
  const Rows rows = shared_rows(left, right);
  const double shorter =
      std::min(left.v_bottom_px - left.v_top_px, right.v_bottom_px - right.v_top_px);
  constexpr double kFilled_ratio = 0.9;
  return rows.count() >= 3 && rows.count() > 0.5 * shorter &&
         filled_ratio(left, right, rows, depth, table, width_max_m) >= kFilled_ratio;
}

Landmark pole_of(const Landmark& left, const Landmark& right) {
  const Eigen::Vector2d a = place_m(left);
  const Eigen::Vector2d b = place_m(right);
  const double width_m = (a - b).norm();
  const Eigen::Vector2d middle = 0.5 * (a + b);
  const Eigen::Vector2d toward = middle.normalized();
  const Eigen::Vector2d across(-toward.y(), toward.x());
  const double front_m = std::min(middle.norm(), std::min(a.dot(toward), b.dot(toward)));
  const double along_m2 = left.covariance(0, 0) + width_m * width_m / 16.0;
  const double across_m2 = left.covariance(1, 1) * left.range_m * left.range_m;
  Landmark pole = left.rows >= right.rows ? left : right;
  pole.kind = LandmarkKind::kPole;
  set_position(pole, (front_m + 0.5 * width_m) * toward,
               along_m2 * toward * toward.transpose() + across_m2 * across * across.transpose());
  pole.height_low_m = std::min(left.height_low_m, right.height_low_m);
  pole.height_high_m = std::max(left.height_high_m, right.height_high_m);
  pole.u_px = 0.5 * (left.u_px + right.u_px);
  pole.rows = std::max(left.rows, right.rows);
  pole.score_ratio = std::max(left.score_ratio, right.score_ratio);
  pole.v_top_px = std::min(left.v_top_px, right.v_top_px);
  pole.v_bottom_px = std::max(left.v_bottom_px, right.v_bottom_px);
  return pole;
}

}  // namespace

void join_thin_things(std::vector<Landmark>& landmarks, const DepthImage& depth,
                      const DisparityTable& table, double width_max_m) {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (std::size_t j = 0; j < landmarks.size(); ++j) {
      if (!are_of_one_thing(landmarks[i], landmarks[j], depth, table, width_max_m)) continue;
      landmarks[i] = pole_of(landmarks[i], landmarks[j]);
      landmarks.erase(landmarks.begin() + static_cast<std::ptrdiff_t>(j));
      if (j < i) --i;
      break;
    }
  }
}

}  // namespace roomwise::landmark
