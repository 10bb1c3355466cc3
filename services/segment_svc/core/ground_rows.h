#pragma once
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_frame.h"

namespace roomwise::segment {

/// Pixels of one image row in the robot frame laid on the floor.
struct GroundRow {
  std::vector<float> x_m;       ///< forward
  std::vector<float> y_m;       ///< left
  std::vector<float> height_m;  ///< over the floor
  std::vector<std::uint8_t> label;
};

/// Puts some 160 pixels across and as many rows as lie as close into the robot frame: every second
/// pixel of 320 columns, every fourth of 640. Enough to measure with.
///
/// A pixel with a reading lies where it was measured. One labelled unknown is put where its ray
/// meets the floor, or far off if it does not: there something is not known.
class GroundRows {
 public:
  /// For the pixels of `frame`; `labels` are height x width. Both must outlive the calls of row().
  void prepare(const RgbdFrame& frame, const CameraView& view, const FloorFrame& on_floor,
               const std::vector<std::uint8_t>& labels);

  /// Number of rows measured.
  int rows() const { return (view_->height_px() + stride_px_ - 1) / stride_px_; }
  /// From one measured row or column to the next.
  int stride_px() const { return stride_px_; }

  /// Row `index` of those; valid until the next call.
  const GroundRow& row(int index);

 private:
  int stride_px_ = 2;
  const RgbdFrame* frame_ = nullptr;
  const CameraView* view_ = nullptr;
  const std::vector<std::uint8_t>* labels_ = nullptr;
  FloorFrame on_floor_{};
  std::vector<std::uint16_t> steps_;  // of the row's pixels
  std::vector<float> forward_;        // part of a ray along each axis that comes from its column
  std::vector<float> left_;
  std::vector<float> up_;
  GroundRow row_;
};

}  // namespace roomwise::segment
