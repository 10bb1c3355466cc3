#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/labels.h"
#include "tests/support/synthetic_room.h"

namespace roomwise::segment {

/// Colour that only floor has in these scenes.
inline constexpr std::array<std::uint8_t, 3> kFloor_rgb = {150, 120, 90};

/// Two walls, a box and a pole; floor all round.
inline RgbdFrame furnished_frame(const SyntheticCamera& camera, std::uint32_t seed = 1) {
  return render(furnished_room(), camera, Pose2{}, seed);
}

/// Claims a mounting that differs from the true one by these angles about the robot's axes.
inline void mistake_mounting(RgbdFrame& frame, double roll_rad, double pitch_rad) {
  frame.T_robot_camera.linear() =
      (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()) * frame.T_robot_camera.linear())
          .eval();
}

/// The camera truly leans and looks as `roll_rad` and `pitch_rad` say, and its mounting says so
/// too: every ray of a level camera is turned, and the scene rendered by hand: a floor, and a wall.
inline RgbdFrame tilted_floor_frame(double height_m, double roll_rad, double pitch_rad,
                                    double wall_m) {
  RgbdFrame frame = render(SyntheticRoom{}, {.height_m = height_m}, Pose2{}, 1);
  frame.T_robot_camera.linear() =
      (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()) * frame.T_robot_camera.linear())
          .eval();
  const PinholeCamera& camera = frame.depth_camera;
  for (int v = 0; v < frame.depth.height_px; ++v) {
    for (int u = 0; u < frame.depth.width_px; ++u) {
      const Eigen::Vector3d ray =
          frame.T_robot_camera.linear() *
          Eigen::Vector3d((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
      double z_m = wall_m / std::max(ray.x(), 1e-6);
      if (ray.z() < 0.0) z_m = std::min(z_m, -height_m / ray.z());
      const bool is_seen = z_m >= 0.5 && z_m <= 8.0;
      frame.depth.steps[static_cast<std::size_t>(v * frame.depth.width_px + u)] =
          static_cast<std::uint16_t>(is_seen ? std::lround(1000.0 * z_m) : 0);
    }
  }
  return frame;
}

/// Pixels called floor and truly floor, over pixels that are either; unread pixels left out.
inline double floor_iou(const RgbdFrame& frame, const std::vector<std::uint8_t>& labels) {
  int both = 0;
  int either = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (frame.depth.steps[i] == 0 || frame.depth.steps[i] * frame.depth.unit_m > 6.0) continue;
    const bool is_floor = frame.color.rgb[3 * i] == kFloor_rgb[0] &&
                          frame.color.rgb[3 * i + 1] == kFloor_rgb[1] &&
                          frame.color.rgb[3 * i + 2] == kFloor_rgb[2];
    const bool is_called = labels[i] == kAccessible;
    both += is_floor && is_called ? 1 : 0;
    either += is_floor || is_called ? 1 : 0;
  }
  return either == 0 ? 1.0 : static_cast<double>(both) / either;
}

inline int count(const std::vector<std::uint8_t>& labels, Label label) {
  return static_cast<int>(std::count(labels.begin(), labels.end(), std::uint8_t{label}));
}

}  // namespace roomwise::segment
