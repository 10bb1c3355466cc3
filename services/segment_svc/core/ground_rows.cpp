#include "services/segment_svc/core/ground_rows.h"

#include <algorithm>

#include "common/multiversion.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr int kColumns = 160;
constexpr int kStrideMin_px = 2;
constexpr float kFar_m = 50.0F;  // depth given to an unknown pixel that looks at no floor

/// Parts of a row's rays that come from the row, the camera's place, and the depth's unit.
struct RowRay {
  float forward;
  float left;
  float up;
  float forward_m;
  float left_m;
  float up_m;
  float unit_m;
};

ROOMWISE_MULTIVERSION
void project(const std::uint16_t* steps, const float* forward, const float* left, const float* up,
             RowRay ray, std::size_t count, const std::uint8_t* label, float* x_m, float* y_m,
             float* height_m) {
  for (std::size_t i = 0; i < count; ++i) {
    const float rise = up[i] + ray.up;
    const float descent = rise < -1e-3F ? -rise : 1e-3F;
    const float meeting_m = ray.up_m / descent;
    const float floor_m = meeting_m < kFar_m ? meeting_m : kFar_m;
    const float measured_m = ray.unit_m * static_cast<float>(steps[i]);
    const float z_m = label[i] == kUnknown ? floor_m : measured_m;
    x_m[i] = z_m * (forward[i] + ray.forward) + ray.forward_m;
    y_m[i] = z_m * (left[i] + ray.left) + ray.left_m;
    height_m[i] = z_m * rise + ray.up_m;
  }
}

void fill_columns(const CameraView& view, std::size_t stride_px, double per_ray_x,
                  std::vector<float>& columns) {
  const std::vector<float>& ray_x = view.ray_x();
  columns.resize((ray_x.size() + stride_px - 1) / stride_px);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i] = static_cast<float>(per_ray_x) * ray_x[stride_px * i];
  }
}

}  // namespace

void GroundRows::prepare(const RgbdFrame& frame, const CameraView& view, const FloorFrame& on_floor,
                         const std::vector<std::uint8_t>& labels) {
  frame_ = &frame;
  view_ = &view;
  labels_ = &labels;
  on_floor_ = on_floor;
  stride_px_ = std::max(kStrideMin_px, view.width_px() / kColumns);
  const auto stride_px = static_cast<std::size_t>(stride_px_);
  fill_columns(view, stride_px, on_floor.forward.x(), forward_);
  fill_columns(view, stride_px, on_floor.left.x(), left_);
  fill_columns(view, stride_px, on_floor.floor.normal.x(), up_);
  for (auto* values : {&row_.x_m, &row_.y_m, &row_.height_m}) values->resize(forward_.size());
  row_.label.resize(forward_.size());
  steps_.resize(forward_.size());
}

const GroundRow& GroundRows::row(int index) {
  const auto stride_px = static_cast<std::size_t>(stride_px_);
  const std::size_t v = stride_px * static_cast<std::size_t>(index);
  const std::size_t first = v * static_cast<std::size_t>(view_->width_px());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    steps_[i] = frame_->depth.steps[first + stride_px * i];
    row_.label[i] = (*labels_)[first + stride_px * i];
  }
  const float ray_y = view_->ray_y()[v];
  const auto along = [&](const Eigen::Vector3d& axis) {
    return static_cast<float>(axis.y()) * ray_y + static_cast<float>(axis.z());
  };
  const RowRay ray{.forward = along(on_floor_.forward),
                   .left = along(on_floor_.left),
                   .up = along(on_floor_.floor.normal),
                   .forward_m = static_cast<float>(on_floor_.forward_m),
                   .left_m = static_cast<float>(on_floor_.left_m),
                   .up_m = static_cast<float>(on_floor_.floor.height_m),
                   .unit_m = static_cast<float>(view_->unit_m())};
  project(steps_.data(), forward_.data(), left_.data(), up_.data(), ray, steps_.size(),
          row_.label.data(), row_.x_m.data(), row_.y_m.data(), row_.height_m.data());
  return row_;
}

}  // namespace roomwise::segment
