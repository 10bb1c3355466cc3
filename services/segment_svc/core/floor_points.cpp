#include "services/segment_svc/core/floor_points.h"

#include <algorithm>
#include <cmath>

namespace roomwise::segment {
namespace {

constexpr double kPointsAcross = 640.0 / 6.0;
constexpr float kSteep = 0.5F;  // sine of 30 degrees

/// Points of a frame by pixel.
class Cloud {
 public:
  Cloud(const RgbdFrame& frame, const CameraView& view)
      : frame_(frame), view_(view), unit_m_(static_cast<float>(view.unit_m())) {}

  /// At the origin where there is no reading.
  Eigen::Vector3f at(int u, int v) const {
    const float z_m = unit_m_ * static_cast<float>(frame_.depth.at(u, v));
    return {z_m * view_.ray_x()[static_cast<std::size_t>(u)],
            z_m * view_.ray_y()[static_cast<std::size_t>(v)], z_m};
  }

  /// Between the rows `step_px` above and below; the pixel's own reading stands in for a missing
  /// one. Errors of depth do not raise floor: they lie along rays that graze it.
  bool is_steep(int u, int v, int step_px, const Eigen::Vector3f& p,
                const Eigen::Vector3f& up) const {
    Eigen::Vector3f above = at(u, std::max(0, v - step_px));
    Eigen::Vector3f below = at(u, std::min(view_.height_px() - 1, v + step_px));
    if (!(above.z() > 0.0F)) above = p;
    if (!(below.z() > 0.0F)) below = p;
    const Eigen::Vector3f along = above - below;
    return std::abs(up.dot(along)) > kSteep * along.norm();
  }

 private:
  const RgbdFrame& frame_;
  const CameraView& view_;
  float unit_m_;
};

}  // namespace

void sample_points(const RgbdFrame& frame, const CameraView& view, double range_max_m,
                   const Eigen::Vector3f& up, std::vector<FloorPoint>& points) {
  points.clear();
  const int step_px = std::max(1, static_cast<int>(std::lround(view.width_px() / kPointsAcross)));
  const auto across = static_cast<std::size_t>(view.width_px() / step_px + 1);
  points.reserve(across * static_cast<std::size_t>(view.height_px() / step_px + 1));
  const Cloud cloud(frame, view);
  const auto far_m = static_cast<float>(range_max_m);
  for (int v = step_px / 2; v < view.height_px(); v += step_px) {
    for (int u = step_px / 2; u < view.width_px(); u += step_px) {
      const Eigen::Vector3f p = cloud.at(u, v);
      if (!(p.z() > 0.0F) || p.z() > far_m || cloud.is_steep(u, v, step_px, p, up)) continue;
      points.push_back({p, p.z() * p.z() * view.quantum_per_m()});
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
