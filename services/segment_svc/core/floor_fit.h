#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_plane.h"
#include "services/segment_svc/core/floor_points.h"
#include "services/segment_svc/core/floor_search.h"
#include "services/segment_svc/core/segment_params.h"

namespace roomwise::segment {

/// The floor of one frame, and whether to believe it.
struct FloorEstimate {
  FloorPlane plane;
  int inliers = 0;
  bool trusted = false;  ///< false: kept from before, or from the mounting
};

/// Finds the floor anew in every frame, so that a camera that tips or climbs does no harm.
///
/// It is followed from frame to frame: the better of the last plane as the camera saw it, as its
/// mounting moved, and of its height at the mounting's tilt, refined by rounds of weighted least
/// squares over a shrinking band. Where there is no last plane, or it is lost, the mounting's own
/// plane is tried and then FloorSearch's. A plane is believed if enough points lie on it and crowd
/// there, it is near the mounting's tilt, and it lies within the allowed heights: so a wall never
/// becomes the floor. A plane with much beneath it gives way to a lower one (it was a table), but
/// for the one the mounting says (then what is beneath are stairs).
class FloorFit {
 public:
  explicit FloorFit(const SegmentParams& params);

  FloorEstimate fit(const RgbdFrame& frame, const CameraView& view);

 private:
  FloorPlane predict(const FloorPlane& mounted, const Eigen::Isometry3d& T_robot_camera) const;
  std::optional<FloorEstimate> track(const FloorPlane& mounted,
                                     const Eigen::Isometry3d& T_robot_camera);
  std::optional<FloorEstimate> start(const FloorPlane& mounted);
  std::optional<FloorEstimate> find(const FloorPlane& mounted);
  std::optional<FloorEstimate> settle(const FloorPlane& from, const FloorPlane& mounted);
  FloorPlane refine(const FloorPlane& start, double band_m) const;
  bool is_allowed(const FloorPlane& plane, const FloorPlane& mounted) const;

  SegmentParams params_;
  FloorSearch search_;
  std::vector<FloorPoint> points_;
  int beneath_ = 0;                 // points under the plane that settled last
  std::optional<FloorPlane> last_;  // last one believed
  Eigen::Isometry3d T_robot_last_;  // mounting it was seen from
};

}  // namespace roomwise::segment
