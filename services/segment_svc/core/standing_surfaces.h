#pragma once
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_plane.h"

namespace roomwise::segment {

/// Finds the feet of what stands on the floor: the lowest centimetres of walls and furniture, which
/// lie within the floor's tolerance.
///
/// Along a pixel column a vertical surface keeps its distance X ahead, while the floor's grows with
/// every row up; so 1/X, which carries the sensor's even disparity noise, stays level on the
/// surface and is known in closed form on the floor,
///
///   1/X_floor = -(n . r) / (h (d . r)),   1/X = 1 / (z (d . r))
///
/// with r the pixel's ray, n and h the floor's normal and the camera's height, d the view's
/// direction laid flat. The two meet at the foot. Rows are gone through from the top; 1/X of the
/// obstacle pixels above is averaged per column, and floor pixels below them are theirs as long as
/// they read as the surface does and the floor behind them would be farther than it.
class StandingSurfaces {
 public:
  /// Turns accessible labels (height x width) of feet into obstacle labels.
  void mark(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
            std::vector<std::uint8_t>& labels);

 private:
  std::vector<float> rise_of_column_;  // part of n . r and of d . r that comes from the column
  std::vector<float> ahead_of_column_;
  std::vector<float> surface_per_m_;  // mean 1/X of the obstacle right above
  std::vector<float> rows_;           // how many rows it was averaged over, 0: none
  std::vector<float> z_m_;            // of a row; and its labels: all as wide as a float, so that
  std::vector<std::int32_t> label_;   // the loop over them keeps to its registers
};

}  // namespace roomwise::segment
