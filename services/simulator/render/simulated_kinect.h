#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/simulator/core/kinect/color_sensor.h"
#include "services/simulator/core/kinect/depth_sensor.h"
#include "services/simulator/core/kinect/kinect_params.h"
#include "services/simulator/core/scene.h"
#include "services/simulator/render/kinect_renderer.h"

namespace roomwise::simulator {

/// What the host asked the camera for.
struct KinectMode {
  int width_px = 640;  ///< 640 x 480 or 320 x 240
  int height_px = 480;
  bool registered = true;
};

/// A Kinect in a scene: ideal views, then the failings of both its sensors.
class SimulatedKinect {
 public:
  /// `scene` must outlive it. Throws std::runtime_error if a mesh is broken or Embree fails.
  SimulatedKinect(const Scene& scene, const DepthSensorParams& depth,
                  const ColorSensorParams& color, std::uint32_t seed);

  /// Takes frame number `frame`, `t_s` after the start: fills depth, colour, both cameras and the
  /// registration of `out`; time, sequence number and mounting are the caller's.
  ///
  /// Registered: both images are what the colour camera at T_world_camera sees. It is nearer to the
  /// projector than the depth camera, so shadows are narrower. Not registered: T_world_camera is
  /// the depth camera's; the colour camera sits to its right. The same scene, seed and calls give
  /// the same bytes.
  void capture(const Eigen::Isometry3d& T_world_camera, double t_s, std::int64_t frame,
               const KinectMode& mode, RgbdFrame& out);

  /// Of the last frame: what it would be without the sensors' failings.
  const KinectView& view() const { return view_; }
  /// Of the last frame: disparities in quanta of 1/8 px; raw_shift() makes 11-bit values of them.
  std::span<const std::uint16_t> quanta() const { return depth_sensor_.quanta(); }

 private:
  void look(const Eigen::Isometry3d& T_world_camera, double t_s, const RgbdFrame& frame,
            const KinectMode& mode);

  DepthSensorParams depth_params_;
  ColorSensorParams color_params_;
  KinectRenderer renderer_;
  DepthSensor depth_sensor_;
  ColorSensor color_sensor_;
  KinectView view_;
};

}  // namespace roomwise::simulator
