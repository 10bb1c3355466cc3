#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"

namespace roomwise::landmark {

/// The floor as the camera sees it.
struct FloorView {
  Eigen::Vector3d down_camera;  ///< unit vector
  double height_m = 0.0;        ///< of the camera above it
  int points = 0;               ///< readings that speak for it; 0: as mounted
};

/// Corrects the mounted tilt and height of the camera by the floor in view, every frame: wheels
/// sink, robots nod.
///
/// With down n, height H and Q = 8 f b the floor's disparity is linear in the image,
///
///   D(u, v) = g . (x, y, 1),   g = (Q / H) n,   x = (u - cx) / fx,   y = (v - cy) / fy,
///
/// and a reading D lies h = H (1 - g . (x, y, 1) / D) above it. Three rounds of least squares for g
/// over readings within 10, 5, 3 cm and 2 quanta of the last plane, on a grid of about 80 columns.
/// Noise is uniform in disparity, so all weigh alike; the mounting is one more measurement, with a
/// sigma of 5 % of |g|: about 3 degrees or 5 % of the height, to keep what no floor in view tells.
/// Falls back to the mounting with fewer than 40 readings or 15 degrees and more from it.
///
/// Readings are looked up once for all rounds, and only in rows that can show the floor.
class FloorFitter {
 public:
  /// Makes room for images of that size: fit() allocates nothing then.
  void reserve(int width_px, int height_px);
  /// Nothing if the mounted camera is not between 5 cm and 3 m above the floor.
  std::optional<FloorView> fit(const DepthImage& depth, const PinholeCamera& camera,
                               const DisparityTable& table,
                               const Eigen::Isometry3d& T_robot_camera);

 private:
  struct Round;
  Round gather_near(const DepthImage& depth, const PinholeCamera& camera,
                    const DisparityTable& table, const Eigen::Vector3d& gradient,
                    double band_ratio);
  /// Disparities of a row of the grid [quanta]; 0: bad data.
  const float* row_quanta(const DepthImage& depth, const DisparityTable& table, int row);

  std::vector<float> quanta_;               // of the grid, row by row
  std::vector<std::uint8_t> is_looked_up_;  // of each row
};

}  // namespace roomwise::landmark
