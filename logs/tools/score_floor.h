#pragma once
#include <cstdint>
#include <opencv2/core.hpp>

namespace roomwise {

/// Pixels of a label image against a mask, by what is true and what was said.
struct FloorCounts {
  std::int64_t floor_called_floor = 0;
  std::int64_t floor_called_other = 0;
  std::int64_t other_called_floor = 0;
  std::int64_t other_called_other = 0;

  FloorCounts& operator+=(const FloorCounts& more);

  /// Ratios of pixels; 0 where there is nothing to divide by.
  double iou_ratio() const;
  double precision_ratio() const;
  double recall_ratio() const;
  double nonfloor_called_floor_ratio() const;
};

/// Counts the pixels of `mask` (255 floor, 0 not floor, anything else is left out) by `labels`
/// (segmentation_t::LABEL_ACCESSIBLE is floor). Where the sizes differ, a mask pixel takes the
/// label at the same place of the image.
FloorCounts count_floor(const cv::Mat1b& labels, const cv::Mat1b& mask);

}  // namespace roomwise
