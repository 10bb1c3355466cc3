#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_plane.h"

namespace roomwise::segment {

/// A depth reading in space.
struct FloorPoint {
  Eigen::Vector3f p_camera_m;
  float quantum_m;  ///< depth of one disparity quantum here
};

/// Height over a plane, and its error by one disparity quantum. The error lies along the ray; only
/// its part along the normal changes the height.
struct PointHeight {
  float height_m;
  float sigma_m;
};

/// A plane in the precision of the points.
class FloatPlane {
 public:
  explicit FloatPlane(const FloorPlane& plane)
      : normal_(plane.normal.cast<float>()), height_m_(static_cast<float>(plane.height_m)) {}
  PointHeight operator()(const FloorPoint& point) const {
    const float rise_m = normal_.dot(point.p_camera_m);
    return {.height_m = rise_m + height_m_,
            .sigma_m = point.quantum_m * std::abs(rise_m) / point.p_camera_m.z()};
  }

 private:
  Eigen::Vector3f normal_;
  float height_m_;
};

/// Readings on a grid of about 107 x 80 points, whatever the image's size; cleared first. Readings
/// beyond `range_max_m` are left out.
void sample_points(const RgbdFrame& frame, const CameraView& view, double range_max_m,
                   std::vector<FloorPoint>& points);

/// How well a plane explains a set of points.
struct PlaneSupport {
  int on = 0;       ///< |height| <= tolerance + sigma
  int core = 0;     ///< |height| <= tolerance / 2 + sigma
  int skirt = 0;    ///< |height| <= 3 (tolerance / 2 + sigma)
  int beneath = 0;  ///< height < -(drop + 3 sigma)

  /// Points of a flat surface crowd at height 0; points of a wall that a plane cuts, or of clutter,
  /// fill the skirt evenly, and a third of them lie in the core.
  bool is_flat() const { return 2 * core > skirt; }
};

PlaneSupport support_of(const FloorPlane& plane, const std::vector<FloorPoint>& points,
                        double tolerance_m, double drop_m);

}  // namespace roomwise::segment
