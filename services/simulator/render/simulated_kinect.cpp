#include "services/simulator/render/simulated_kinect.h"

namespace roomwise::simulator {

SimulatedKinect::SimulatedKinect(const Scene& scene, const DepthSensorParams& depth,
                                 const ColorSensorParams& color, std::uint32_t seed)
    : depth_params_(depth),
      color_params_(color),
      renderer_(scene),
      depth_sensor_(depth, seed),
      color_sensor_(color, seed) {}

void SimulatedKinect::look(const Eigen::Isometry3d& T_world_camera, double t_s,
                           const RgbdFrame& frame, const KinectMode& mode) {
  if (mode.registered) {
    renderer_.render(T_world_camera, frame.depth_camera, t_s, mode.width_px, mode.height_px, view_);
    return;
  }
  const Eigen::Isometry3d T_world_color =
      T_world_camera * Eigen::Translation3d(color_params_.color_offset_m, 0.0, 0.0);
  renderer_.render(T_world_camera, frame.depth_camera, T_world_color, frame.color_camera, t_s,
                   mode.width_px, mode.height_px, view_);
}

void SimulatedKinect::capture(const Eigen::Isometry3d& T_world_camera, double t_s,
                              std::int64_t frame, const KinectMode& mode, RgbdFrame& out) {
  const auto camera = [&mode](double focal_px) {
    return kinect_camera(focal_px, mode.width_px, mode.height_px);
  };
  out.depth_registered = mode.registered;
  out.color_camera = camera(color_params_.color_focal_px);
  out.depth_camera = mode.registered ? out.color_camera : camera(depth_params_.depth_focal_px);
  look(T_world_camera, t_s, out, mode);
  const double projector_m =
      depth_params_.projector_m - (mode.registered ? color_params_.color_offset_m : 0.0);
  depth_sensor_.expose(view_, out.depth_camera.fx_px * projector_m, frame, out.depth);
  color_sensor_.expose(view_, frame, t_s, out.color);
}

}  // namespace roomwise::simulator
