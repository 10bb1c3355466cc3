#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/floor_fit.h"
#include "services/landmark_svc/core/region_of_interest.h"
#include "services/landmark_svc/core/scan_clusters.h"

namespace roomwise::landmark {

/// Which part of the view makes the scan.
struct VirtualScanParams {
  double height_low_m = 0.10;   ///< lower edge of the slice, above the floor
  double height_high_m = 0.60;  ///< upper edge
  int row_step_px = 2;          ///< every how many rows are looked at, at 480 px image height
  double rows_min_px = 4.0;     ///< rows that must agree on a column's distance, of those looked at
};

/// The nearest thing of one column within the slice.
struct ScanPoint {
  int u_px = 0;
  Eigen::Vector2d p_robot_m{0.0, 0.0};
  double along_m = 0.0;  ///< distance along the camera's horizontal viewing direction
  int rows = 0;          ///< that agree
  int v_top_px = 0;
  int v_bottom_px = 0;
};

/// What a planar laser scanner in the camera's place would see, with tilt and floor taken out: for
/// each column the mean of the nearest cluster of readings whose height is within the slice. What
/// has no reading is left out: unknown, not free.
///
/// Readings are compared by Q / r, r the distance along the level viewing direction: equal for all
/// heights of an upright surface, with the noise of one disparity quantum. ScanClusters sorts them
/// while the rows go by, so one pass over the image does.
class VirtualScan {
 public:
  /// Makes room for images of that width: make() allocates nothing then.
  void reserve(int width_px);
  /// Replaces points().
  void make(const DepthImage& depth, const PinholeCamera& camera, const DisparityTable& table,
            const FloorView& floor, const Eigen::Isometry3d& T_robot_camera,
            const PixelRectangle& region, const VirtualScanParams& params);
  void clear() {
    points_.clear();
    open_px_.clear();
  }

  /// Columns ascending.
  const std::vector<ScanPoint>& points() const { return points_; }
  /// Columns without a point that have readings beyond 4095 mm within the slice: they say no
  /// distance, but that nothing nearer stands there. Ascending.
  const std::vector<int>& open_px() const { return open_px_; }
  /// Level viewing direction, robot frame, and where the camera is.
  const Eigen::Vector2d& forward() const { return forward_; }
  const Eigen::Vector2d& origin_m() const { return origin_m_; }

 private:
  void place_points(const PinholeCamera& camera, const DisparityTable& table,
                    const Eigen::Vector3d& along, const Eigen::Vector3d& left,
                    const PixelRectangle& region, double rows_min);

  std::vector<float> quanta_;  // of a row's columns: the reading within the slice, 0 for none
  ScanClusters clusters_;
  std::vector<std::uint16_t> beyond_rows_;  // of each column
  std::vector<ScanPoint> points_;
  std::vector<int> open_px_;
  Eigen::Vector2d forward_{1.0, 0.0};
  Eigen::Vector2d origin_m_{0.0, 0.0};
};

}  // namespace roomwise::landmark
