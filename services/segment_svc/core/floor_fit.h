#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_plane.h"
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
/// A grid of depth points votes for planes near the mounting's tilt at any allowed height: points
/// within 6 cm count for a plane, points more than 10 cm below it count twice against (a table top
/// or shelf is not the floor). The best of these, of the last frame's plane and of the mounting's
/// tilt at the last height is refined by three rounds of weighted least squares over a shrinking
/// band. A plane is believed if enough points lie on it, it is not far from the mounting's tilt,
/// and it lies within the allowed heights: so a wall never becomes the floor.
class FloorFit {
 public:
  explicit FloorFit(const SegmentParams& params) : params_(params) {}

  FloorEstimate fit(const RgbdFrame& frame, const CameraView& view);

 private:
  struct Point {
    Eigen::Vector3f p_camera_m;
    float quantum_m;  ///< depth of one disparity quantum here
  };
  void sample(const RgbdFrame& frame, const CameraView& view);
  FloorPlane search(const FloorPlane& mounted);
  FloorPlane best_height(const Eigen::Vector3d& normal, int& best_votes);
  int votes(const FloorPlane& plane) const;
  FloorPlane refine(const FloorPlane& start, const FloorPlane& mounted) const;
  FloorPlane refine_once(const FloorPlane& start, const FloorPlane& mounted, double band_m) const;
  int count_inliers(const FloorPlane& plane) const;
  bool is_allowed(const FloorPlane& plane, const FloorPlane& mounted) const;

  static constexpr int kHeightBins = 160;  // of 2 cm: up to 3.2 m

  SegmentParams params_;
  std::vector<Point> points_;
  std::array<int, kHeightBins> below_{};  // points at most this far below the camera
  FloorEstimate last_;
};

}  // namespace roomwise::segment
