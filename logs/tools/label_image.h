#pragma once
#include <opencv2/core.hpp>
#include <optional>

#include "roomwise/segmentation_t.hpp"

namespace roomwise {

/// The label image of a SEGMENTS message, segmentation_t::LABEL_* a pixel. None if its data is not
/// exactly such an image, or a side is not in [1, 4096]; nothing in the message can make it throw
/// or allocate more than that image.
std::optional<cv::Mat1b> decode_labels(const segmentation_t& message);

}  // namespace roomwise
