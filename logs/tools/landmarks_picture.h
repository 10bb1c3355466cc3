#pragma once
#include <opencv2/core.hpp>

#include "common/image/rgbd_frame.h"
#include "roomwise/landmark_list_t.hpp"

namespace roomwise {

/// Draws edge pixels and landmarks on the colour image: a stroke over the rows that support each,
/// coloured by kind, with its range. What lies outside the image is left out.
cv::Mat3b draw_landmarks(const RgbdFrame& frame, const landmark_list_t& landmarks);

}  // namespace roomwise
