#include "services/segment_svc/core/floor_points.h"

#include <algorithm>
#include <cmath>

namespace roomwise::segment {
namespace {

constexpr double kPointsAcross = 640.0 / 6.0;

}  // namespace

void sample_points(const RgbdFrame& frame, const CameraView& view, double range_max_m,
                   std::vector<FloorPoint>& points) {
  points.clear();
  const int step_px = std::max(1, static_cast<int>(std::lround(view.width_px() / kPointsAcross)));
  const auto across = static_cast<std::size_t>(view.width_px() / step_px + 1);
  points.reserve(across * static_cast<std::size_t>(view.height_px() / step_px + 1));
  const auto unit_m = static_cast<float>(view.unit_m());
  const auto far_m = static_cast<float>(range_max_m);
  for (int v = step_px / 2; v < view.height_px(); v += step_px) {
    const float y = view.ray_y()[static_cast<std::size_t>(v)];
    for (int u = step_px / 2; u < view.width_px(); u += step_px) {
      const float z_m = unit_m * static_cast<float>(frame.depth.at(u, v));
      if (!(z_m > 0.0F) || z_m > far_m) continue;
      const float x = view.ray_x()[static_cast<std::size_t>(u)];
      points.push_back({Eigen::Vector3f(z_m * x, z_m * y, z_m), z_m * z_m * view.quantum_per_m()});
    }
  }
}

PlaneSupport support_of(const FloorPlane& plane, const std::vector<FloorPoint>& points,
                        double tolerance_m, double drop_m) {
  const FloatPlane height_of(plane);
  const auto tolerance = static_cast<float>(tolerance_m);
  const auto drop = static_cast<float>(drop_m);
  PlaneSupport support;
  for (const FloorPoint& point : points) {
    const auto [height_m, sigma_m] = height_of(point);
    const float off_m = std::abs(height_m);
    const float half_m = 0.5F * tolerance + sigma_m;
    support.on += off_m <= tolerance + sigma_m ? 1 : 0;
    support.core += off_m <= half_m ? 1 : 0;
    support.skirt += off_m <= 3.0F * half_m ? 1 : 0;
    support.beneath += height_m < -(drop + 3.0F * sigma_m) ? 1 : 0;
  }
  return support;
}

}  // namespace roomwise::segment
