#include "tests/bench/upright_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace roomwise {
namespace {

constexpr int kBeside_px = 3;
constexpr int kRowsMin_px = 18;  // at 480 px image height
constexpr int kSlender = 4;      // times as high as wide, or narrower than this

/// The nearest reading beside a pixel; 0: none.
int nearest_steps(const DepthImage& depth, int u_px, int v_px) {
  int nearest = 0;
  for (int u = std::max(0, u_px - kBeside_px); u <= std::min(depth.width_px - 1, u_px + kBeside_px);
       ++u) {
    const int steps = depth.at(u, v_px);
    if (steps != 0 && (nearest == 0 || steps < nearest)) nearest = steps;
  }
  return nearest;
}

std::optional<double> depth_beside_m(const DepthImage& depth, int u_px, int top_px, int rows_px) {
  std::vector<int> steps;
  for (int v = top_px; v < top_px + rows_px; ++v) {
    if (const int nearest = nearest_steps(depth, u_px, v); nearest != 0) steps.push_back(nearest);
  }
  if (steps.empty()) return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle * depth.unit_m;
}

}  // namespace

std::vector<Eigen::Vector2d> upright_edges_m(const cv::Mat& edges, const RgbdFrame& frame) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  const int components = cv::connectedComponentsWithStats(edges, labels, stats, centres, 8, CV_32S);
  const int rows_min_px = kRowsMin_px * frame.depth.height_px / 480;
  std::vector<Eigen::Vector2d> places_m;
  for (int k = 1; k < components; ++k) {
    const int rows_px = stats.at<int>(k, cv::CC_STAT_HEIGHT);
    const int width_px = stats.at<int>(k, cv::CC_STAT_WIDTH);
    if (rows_px < rows_min_px || std::max(width_px, kSlender) * kSlender > rows_px) continue;
    const double u_px = centres.at<double>(k, 0);
    const int top_px = stats.at<int>(k, cv::CC_STAT_TOP);
    const auto z_m = depth_beside_m(frame.depth, cvRound(u_px), top_px, rows_px);
    if (!z_m) continue;
    const PinholeCamera& camera = frame.depth_camera;
    const Eigen::Vector3d p_camera_m(
        (u_px - camera.cx_px) / camera.fx_px * *z_m,
        (centres.at<double>(k, 1) - camera.cy_px) / camera.fy_px * *z_m, *z_m);
    places_m.emplace_back((frame.T_robot_camera * p_camera_m).head<2>());
  }
  return places_m;
}

}  // namespace roomwise
