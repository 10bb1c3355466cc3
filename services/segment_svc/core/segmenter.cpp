#include "services/segment_svc/core/segmenter.h"

#include <algorithm>

#include "services/segment_svc/core/edges/edge_labels.h"
#include "services/segment_svc/core/floor_frame.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

void forget_unread(const DepthImage& depth, std::vector<std::uint8_t>& labels) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (depth.steps[i] == 0) labels[i] = kUnknown;
  }
}

}  // namespace

Segmenter::Segmenter(const SegmentParams& params)
    : params_(params),
      floor_fit_(params),
      geometry_(params),
      free_range_(params),
      corridor_(params) {}

void Segmenter::learn(const ColorModel& taught) {
  grey_.emplace(taught.grey);
  table_.emplace(taught.mixtures);
  fused_.teach(taught);
}

void Segmenter::segment(const RgbdFrame& frame, Segmentation& result) {
  view_.prepare(frame, params_.baseline_m);
  result.floor = floor_fit_.fit(frame, view_);
  geometry_.label(frame, view_, result.floor.plane, result.labels);
  look_around(frame, result);
  model_in_force_ = label(frame, result);
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
  free_range_.end(ground_.stride_px() / std::max(focal_times_height, 1.0), result.bearings);
  result.corridor = corridor_.end();
}

const char* Segmenter::label(const RgbdFrame& frame, Segmentation& result) {
  std::vector<std::uint8_t>& labels = result.labels;
  if (params_.model == "fused") {
    fused_.correct(frame, view_, result.floor.plane, labels);
    return "fused";
  }
  if (frame.color.empty() || !grey_) return "geometry";
  if (params_.model == "gaussian") {
    const auto by_grey = [&](const std::uint8_t* rgb) {
      return grey_->classify(grey_level(rgb[0], rgb[1], rgb[2]));
    };
    paint(frame, by_grey, labels);
    return "gaussian";
  }
  if (params_.model == "mixture") {
    paint(
        frame, [&](const std::uint8_t* rgb) { return table_->classify(rgb); }, labels);
    return "mixture";
  }
  if (params_.model == "edges") {
    labels = label_by_edges(frame.color, *table_, view_.width_px(), view_.height_px());
    if (params_.color_needs_depth) forget_unread(frame.depth, labels);
    return "edges";
  }
  return "geometry";
}

template <class Classifier>
void Segmenter::paint(const RgbdFrame& frame, const Classifier& label_of,
                      std::vector<std::uint8_t>& labels) {
  const auto width = static_cast<std::size_t>(view_.width_px());
  colors_.prepare(frame.color, view_.width_px(), view_.height_px());
  for (std::size_t v = 0, pixel = 0; pixel < labels.size(); ++v) {
    const std::uint8_t* row = colors_.row(v);
    for (std::size_t u = 0; u < width; ++u, ++pixel) {
      const bool is_blind = params_.color_needs_depth && frame.depth.steps[pixel] == 0;
      labels[pixel] = is_blind ? kUnknown : label_of(colors_.at(row, u));
    }
  }
}

}  // namespace roomwise::segment
