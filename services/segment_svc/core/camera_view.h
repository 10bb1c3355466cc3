#pragma once
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise::segment {

/// What the algorithms need of a camera, worked out once per camera and image size.
///
/// A pixel's ray is (x, y, 1) with x from its column and y from its row; its point is depth times
/// that, in the camera frame (z forward, x right, y down).
class CameraView {
 public:
  /// Prepares for frames like `frame`; cheap when nothing has changed.
  /// `baseline_m`: between projector and camera.
  void prepare(const RgbdFrame& frame, double baseline_m);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  const PinholeCamera& camera() const { return camera_; }
  const std::vector<float>& ray_x() const { return ray_x_; }  ///< width
  const std::vector<float>& ray_y() const { return ray_y_; }  ///< height
  double unit_m() const { return unit_m_; }

  /// Depth that one disparity quantum is worth at depth z is z^2 times this [1/m].
  /// A Kinect measures to 1/8 pixel of a 640-wide image: quantum = z^2 / (8 f b).
  float quantum_per_m() const { return quantum_per_m_; }

 private:
  int width_px_ = 0;
  int height_px_ = 0;
  PinholeCamera camera_;
  double unit_m_ = 0.0;
  double baseline_m_ = 0.0;
  float quantum_per_m_ = 0.0F;
  std::vector<float> ray_x_;
  std::vector<float> ray_y_;
};

}  // namespace roomwise::segment
