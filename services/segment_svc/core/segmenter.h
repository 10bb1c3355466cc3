#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/corridor.h"
#include "services/segment_svc/core/floor_fit.h"
#include "services/segment_svc/core/free_range.h"
#include "services/segment_svc/core/geometry_labels.h"
#include "services/segment_svc/core/grey_gaussians.h"
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
/// from it, comes from the model: "geometry", or "gaussian", the thesis's grey Gaussians, once
/// there is a classifier; a colour image of another size than the depth image is thinned out to it.
class Segmenter {
 public:
  explicit Segmenter(const SegmentParams& params);

  void set_classifier(const GreyClassifier& classifier) { classifier_ = classifier; }

  /// Fills `result`, reusing its memory. `frame` must be as FrameDecoder lets through.
  void segment(const RgbdFrame& frame, Segmentation& result);

  /// Model that labelled the last frame.
  const char* model_in_force() const { return labelled_by_grey_ ? "gaussian" : "geometry"; }

 private:
  void look_around(const RgbdFrame& frame, Segmentation& result);
  void label_by_grey(const RgbdFrame& frame, std::vector<std::uint8_t>& labels) const;

  SegmentParams params_;
  CameraView view_;
  FloorFit floor_fit_;
  GeometryLabels geometry_;
  GroundRows ground_;
  FreeRange free_range_;
  Corridor corridor_;
  std::optional<GreyClassifier> classifier_;
  bool labelled_by_grey_ = false;
};

}  // namespace roomwise::segment
