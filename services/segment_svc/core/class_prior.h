#pragma once
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/color/class_scores.h"
#include "services/segment_svc/core/floor_plane.h"

namespace roomwise::segment {

/// Depth at which the rays of an image row meet the floor; infinite where they never do.
float floor_depth_m(const CameraView& view, const FloorPlane& floor, int row_px);

/// ln p(class | place) of an image row, by where its rays would meet the floor: near the robot is
/// mostly floor, above the horizon there is none.
ClassScores log_location_prior(const CameraView& view, const FloorPlane& floor, int row_px);

/// ln p(geometry's label | class): how often GeometryLabels calls that class so. For a drop-off,
/// which no colour tells, nothing: 0 for all.
ClassScores log_geometry_says(Label label);

}  // namespace roomwise::segment
