#include "tests/support/synthetic_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace roomwise {
namespace {

struct Hit {
  double depth_m = std::numeric_limits<double>::infinity();
  std::array<std::uint8_t, 3> rgb{};
};

/// Entry of the ray p + s d into the box, in multiples of d; infinity if it misses (slab method).
double entry(const SyntheticBox& box, const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.low_m[axis] - p[axis]) / d[axis];
    const double b = (box.high_m[axis] - p[axis]) / d[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first < last ? first : std::numeric_limits<double>::infinity();
}

Hit cast(const SyntheticRoom& room, const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
  Hit hit;
  if (room.has_floor && d.z() < 0.0) hit = {.depth_m = -p.z() / d.z(), .rgb = room.floor_rgb};
  for (const SyntheticBox& box : room.boxes) {
    const double depth_m = entry(box, p, d);
    if (depth_m < hit.depth_m) hit = {.depth_m = depth_m, .rgb = box.rgb};
  }
  return hit;
}

Eigen::Isometry3d mounting(const SyntheticCamera& camera) {
  // Columns: the camera's x (right), y (down) and z (forward) in the robot frame.
  Eigen::Matrix3d level;
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear() =
      Eigen::AngleAxisd(camera.pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() * level;
  T_robot_camera.translation() = Eigen::Vector3d(0.0, 0.0, camera.height_m);
  return T_robot_camera;
}

Eigen::Isometry3d in_space(const Pose2& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(pose.x_m, pose.y_m, 0.0);
  return T;
}

std::uint16_t measured_mm(double depth_m, double noise_quanta, const SyntheticCamera& camera) {
  if (depth_m < 0.5 || depth_m > 8.0) return 0;
  const double quanta = std::round(camera.quantum_per_inverse_m / depth_m + noise_quanta);
  return static_cast<std::uint16_t>(std::lround(1000.0 * camera.quantum_per_inverse_m / quanta));
}

RgbdFrame blank_frame(const SyntheticCamera& camera) {
  RgbdFrame frame;
  const auto pixels =
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  frame.depth = {.width_px = camera.width_px,
                 .height_px = camera.height_px,
                 .unit_m = 0.001,
                 .steps = std::vector<std::uint16_t>(pixels)};
  frame.color = {.width_px = camera.width_px,
                 .height_px = camera.height_px,
                 .rgb = std::vector<std::uint8_t>(3 * pixels)};
  const double focal_px = camera.focal_px * camera.width_px / 640.0;
  frame.depth_camera = {.fx_px = focal_px,
                        .fy_px = focal_px,
                        .cx_px = 0.5 * (camera.width_px - 1),
                        .cy_px = 0.5 * (camera.height_px - 1)};
  frame.color_camera = frame.depth_camera;
  frame.depth_registered = true;
  frame.T_robot_camera = mounting(camera);
  return frame;
}

}  // namespace

SyntheticRoom furnished_room() {
  return {.boxes = {
              {.low_m = {4.0, -3.0, 0.0}, .high_m = {4.1, 3.0, 2.5}, .rgb = {200, 200, 190}},
              {.low_m = {0.0, 2.5, 0.0}, .high_m = {4.0, 2.6, 2.5}, .rgb = {190, 200, 200}},
              {.low_m = {2.2, -1.0, 0.0}, .high_m = {2.8, -0.2, 0.8}, .rgb = {60, 80, 160}},
              {.low_m = {2.6, 0.6, 0.0}, .high_m = {2.68, 0.68, 1.6}, .rgb = {160, 60, 60}},
          }};
}

RgbdFrame render(const SyntheticRoom& room, const SyntheticCamera& camera,
                 const Pose2& T_world_robot, std::uint32_t seed) {
  RgbdFrame frame = blank_frame(camera);
  const Eigen::Isometry3d T_world_camera = in_space(T_world_robot) * frame.T_robot_camera;
  std::minstd_rand random(seed + 1);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++pixel) {
      const Eigen::Vector3d ray((u - frame.depth_camera.cx_px) / frame.depth_camera.fx_px,
                                (v - frame.depth_camera.cy_px) / frame.depth_camera.fy_px, 1.0);
      const Hit hit = cast(room, T_world_camera.translation(), T_world_camera.linear() * ray);
      frame.depth.steps[pixel] =
          measured_mm(hit.depth_m, camera.noise_quanta * noise(random), camera);
      std::copy(hit.rgb.begin(), hit.rgb.end(),
                frame.color.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
  }
  return frame;
}

}  // namespace roomwise
