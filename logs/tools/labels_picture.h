#pragma once
#include <opencv2/core.hpp>

#include "common/image/rgbd_frame.h"
#include "roomwise/segmentation_t.hpp"

namespace roomwise {

/// Lays the labels over the colour image, names them beside it with their share of the pixels, and
/// shows the floor plane found and the free range along each bearing.
/// Throws std::runtime_error if the label image cannot be decoded.
cv::Mat3b draw_labels(const RgbdFrame& frame, const segmentation_t& segments);

}  // namespace roomwise
