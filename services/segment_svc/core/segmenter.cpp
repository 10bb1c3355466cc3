#include "services/segment_svc/core/segmenter.h"

#include <algorithm>

#include "services/segment_svc/core/floor_frame.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

Segmenter::Segmenter(const SegmentParams& params)
    : params_(params),
      floor_fit_(params),
      geometry_(params),
      free_range_(params),
      corridor_(params) {}

void Segmenter::segment(const RgbdFrame& frame, Segmentation& result) {
  view_.prepare(frame, params_.baseline_m);
  result.floor = floor_fit_.fit(frame, view_);
  geometry_.label(frame, view_, result.floor.plane, result.labels);
  look_around(frame, result);
  labelled_by_grey_ = params_.model == "gaussian" && classifier_ && !frame.color.empty();
  if (labelled_by_grey_) label_by_grey(frame, result.labels);
  result.distances = measure_distances(frame.depth, params_.range_max_m, result.labels);
}

void Segmenter::look_around(const RgbdFrame& frame, Segmentation& result) {
  ground_.prepare(frame, view_, floor_frame(result.floor.plane, frame.T_robot_camera),
                  result.labels);
  free_range_.begin();
  corridor_.begin();
  for (int i = 0; i < ground_.rows(); ++i) {
    const GroundRow& row = ground_.row(i);
    free_range_.add(row);
    corridor_.add(row);
  }
  // Image rows see the floor z^2 / (f h) apart.
  const double focal_times_height = view_.camera().fy_px * result.floor.plane.height_m;
  free_range_.end(GroundRows::kStride_px / std::max(focal_times_height, 1.0), result.bearings);
  result.corridor = corridor_.end();
}

void Segmenter::label_by_grey(const RgbdFrame& frame, std::vector<std::uint8_t>& labels) const {
  const ColorImage& color = frame.color;
  std::size_t pixel = 0;
  for (int v = 0; v < view_.height_px(); ++v) {
    const int color_v = v * color.height_px / view_.height_px();
    const auto row = static_cast<std::size_t>(color_v) * static_cast<std::size_t>(color.width_px);
    for (int u = 0; u < view_.width_px(); ++u, ++pixel) {
      if (params_.grey_needs_depth && frame.depth.steps[pixel] == 0) {
        labels[pixel] = kUnknown;
        continue;
      }
      const auto color_u = static_cast<std::size_t>(u * color.width_px / view_.width_px());
      const std::uint8_t* rgb = color.rgb.data() + 3 * (row + color_u);
      labels[pixel] = classifier_->classify(grey_level(rgb[0], rgb[1], rgb[2]));
    }
  }
}

}  // namespace roomwise::segment
