#include "services/segment_svc/core/camera_view.h"

namespace roomwise::segment {
namespace {

bool same_camera(const PinholeCamera& a, const PinholeCamera& b) {
  return a.fx_px == b.fx_px && a.fy_px == b.fy_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px;
}

void fill_rays(std::vector<float>& rays, int size_px, double center_px, double focal_px) {
  rays.resize(static_cast<std::size_t>(size_px));
  for (int i = 0; i < size_px; ++i) {
    rays[static_cast<std::size_t>(i)] = static_cast<float>((i - center_px) / focal_px);
  }
}

}  // namespace

void CameraView::prepare(const RgbdFrame& frame, double baseline_m) {
  const DepthImage& depth = frame.depth;
  if (depth.width_px == width_px_ && depth.height_px == height_px_ && depth.unit_m == unit_m_ &&
      baseline_m == baseline_m_ && same_camera(frame.depth_camera, camera_)) {
    return;
  }
  width_px_ = depth.width_px;
  height_px_ = depth.height_px;
  unit_m_ = depth.unit_m;
  baseline_m_ = baseline_m;
  camera_ = frame.depth_camera;
  fill_rays(ray_x_, width_px_, camera_.cx_px, camera_.fx_px);
  fill_rays(ray_y_, height_px_, camera_.cy_px, camera_.fy_px);
  constexpr double kSensorWidth_px = 640.0;  // smaller images are the sensor's, thinned out
  const double sensor_focal_px = camera_.fx_px * kSensorWidth_px / width_px_;
  quantum_per_m_ = static_cast<float>(1.0 / (8.0 * sensor_focal_px * baseline_m));
}

}  // namespace roomwise::segment
