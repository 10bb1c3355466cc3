#include "services/segment_svc/core/segmenter.h"

#include "services/segment_svc/core/floor_frame.h"

namespace roomwise::segment {

Segmenter::Segmenter(const SegmentParams& params)
    : params_(params),
      floor_fit_(params),
      geometry_(params),
      free_range_(params),
      distances_(params) {}

void Segmenter::segment(const RgbdFrame& frame, Segmentation& result) {
  view_.prepare(frame, params_.baseline_m);
  result.floor = floor_fit_.fit(frame, view_);
  geometry_.label(frame, view_, result.floor.plane, result.labels);
  const FloorFrame on_floor = floor_frame(result.floor.plane, frame.T_robot_camera);
  result.distances = distances_.measure(frame, view_, on_floor, result.labels);
  result.bearings = free_range_.measure(frame, view_, on_floor, result.labels);
  labelled_by_grey_ = params_.model == "gaussian" && classifier_ && !frame.color.empty();
  if (labelled_by_grey_) label_by_grey(frame, result.labels);
}

void Segmenter::label_by_grey(const RgbdFrame& frame, std::vector<std::uint8_t>& labels) const {
  const ColorImage& color = frame.color;
  std::size_t pixel = 0;
  for (int v = 0; v < view_.height_px(); ++v) {
    const int color_v = v * color.height_px / view_.height_px();
    const auto row = static_cast<std::size_t>(color_v) * static_cast<std::size_t>(color.width_px);
    for (int u = 0; u < view_.width_px(); ++u, ++pixel) {
      const auto color_u = static_cast<std::size_t>(u * color.width_px / view_.width_px());
      const std::uint8_t* rgb = color.rgb.data() + 3 * (row + color_u);
      labels[pixel] = classifier_->classify(grey_level(rgb[0], rgb[1], rgb[2]));
    }
  }
}

}  // namespace roomwise::segment
