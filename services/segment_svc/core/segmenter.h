#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/color/color_grid.h"
#include "services/segment_svc/core/color/color_model.h"
#include "services/segment_svc/core/color/color_table.h"
#include "services/segment_svc/core/color/grey_gaussians.h"
#include "services/segment_svc/core/corridor.h"
#include "services/segment_svc/core/floor_fit.h"
#include "services/segment_svc/core/free_range.h"
#include "services/segment_svc/core/fused_labels.h"
#include "services/segment_svc/core/geometry_labels.h"
#include "services/segment_svc/core/ground_rows.h"
#include "services/segment_svc/core/segment_params.h"
#include "services/segment_svc/core/view_distances.h"

namespace roomwise::segment {

/// Everything found out about one frame.
struct Segmentation {
  std::vector<std::uint8_t> labels;  ///< height x width of the depth image, values of Label
  FloorEstimate floor;
  ViewDistances distances;
  CorridorView corridor;
  std::array<BearingBin, FreeRange::kBins> bearings{};
};

/// Where the robot can go, frame by frame. Nothing is allocated after the first frame of a size.
///
/// Floor, free range and corridor always come from geometry. The label image, and what is summed up
/// from it, comes from the model: "geometry"; "fused", geometry judged again by colour; or, once
/// taught and where a frame has colour, "gaussian", the thesis's grey Gaussians, "mixture",
/// mixtures of Gaussians over colour, or "edges", those on the regions between edges ("edges"
/// allocates).
class Segmenter {
 public:
  explicit Segmenter(const SegmentParams& params);

  /// From the next frame on, what is taught is this.
  void learn(const ColorModel& taught);

  /// Fills `result`, reusing its memory. `frame` must be as FrameDecoder lets through.
  void segment(const RgbdFrame& frame, Segmentation& result);

  /// Model that labelled the last frame.
  const char* model_in_force() const { return model_in_force_; }

 private:
  void look_around(const RgbdFrame& frame, Segmentation& result);
  /// Name of the model that labelled.
  const char* label(const RgbdFrame& frame, Segmentation& result);
  template <class Classifier>
  void paint(const RgbdFrame& frame, const Classifier& label_of, std::vector<std::uint8_t>& labels);

  SegmentParams params_;
  CameraView view_;
  FloorFit floor_fit_;
  GeometryLabels geometry_;
  GroundRows ground_;
  FreeRange free_range_;
  Corridor corridor_;
  FusedLabels fused_;
  ColorGrid colors_;
  std::optional<GreyClassifier> grey_;
  std::optional<ColorTable> table_;
  const char* model_in_force_ = "geometry";
};

}  // namespace roomwise::segment
