#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_plane.h"
#include "services/segment_svc/core/segment_params.h"
#include "services/segment_svc/core/standing_surfaces.h"
#include "services/segment_svc/core/wall_cells.h"

namespace roomwise::segment {

/// Labels every pixel by its height over the floor; then the feet of what stands on it, and walls
/// among what stands up. Floor that shows above a wall is seen over the wall or in a mirror on it,
/// and no way leads there: unknown.
///
/// With sigma the height's error by one disparity quantum: |h| <= tolerance + sigma is floor,
/// h < -(drop_off_depth + 3 sigma) is a drop-off, no reading (or one beyond the range) is unknown,
/// what lies between floor and drop-off is unknown too; all else is an obstacle, or a wall where
/// WallCells finds one.
class GeometryLabels {
 public:
  explicit GeometryLabels(const SegmentParams& params) : params_(params) {}

  /// Writes height x width labels.
  void label(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
             std::vector<std::uint8_t>& labels);

 private:
  void label_heights(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
                     std::vector<std::uint8_t>& labels);

  void doubt_floor_above_walls(const CameraView& view, std::vector<std::uint8_t>& labels);

  SegmentParams params_;
  StandingSurfaces standing_;
  WallCells walls_;
  std::vector<float> slope_of_column_;    // part of a ray's rise that comes from its column
  std::vector<std::uint8_t> above_wall_;  // by column
};

}  // namespace roomwise::segment
