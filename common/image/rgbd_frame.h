#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace roomwise {

/// No image is wider or higher; what says so is refused.
inline constexpr int kImageSideMax_px = 4096;

/// Pinhole camera without distortion; pixel centres lie at whole numbers.
struct PinholeCamera {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
};

/// Depth along the camera's z, row by row. 0 is no reading: unknown, never free.
struct DepthImage {
  int width_px = 0;
  int height_px = 0;
  double unit_m = 0.001;             ///< metres a step
  std::vector<std::uint16_t> steps;  ///< height x width

  std::size_t size() const { return steps.size(); }
  std::uint16_t at(int u_px, int v_px) const {
    return steps[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_px) +
                 static_cast<std::size_t>(u_px)];
  }
};

/// Colour, row by row, red green blue. Empty where a frame has none.
struct ColorImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3

  bool empty() const { return rgb.empty(); }
};

/// One instant of a depth camera, decoded: what the algorithms work on.
///
/// camera frame: z forward, x right, y down. robot frame: x forward, y left, z up, origin on the
/// floor. T_robot_camera is the pose as mounted; the true tilt may differ by some degrees.
struct RgbdFrame {
  std::int64_t utime = 0;  ///< middle of the exposure, us since the epoch
  std::int64_t seq = 0;
  DepthImage depth;
  std::vector<std::uint8_t> players;  ///< height x width, 0 nobody; empty where a frame has none
  bool depth_registered = false;      ///< depth pixels lie on the colour image's pixels
  PinholeCamera depth_camera;
  ColorImage color;
  PinholeCamera color_camera;
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
};

}  // namespace roomwise
