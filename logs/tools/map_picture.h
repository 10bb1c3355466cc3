#pragma once
#include <opencv2/core.hpp>
#include <string>

#include "logs/tools/recording.h"

namespace roomwise {

/// Draws a recording seen from above: true, odometry and estimated paths, the map's landmarks with
/// their 95 % ellipses, and the true landmarks. All in the frame of TRUTH, where the estimate is
/// put by its best rigid alignment and odometry along with it; without TRUTH in the map frame.
/// Throws std::runtime_error if the recording has nothing to draw.
cv::Mat3b draw_map(const Recording& recording, const std::string& title);

}  // namespace roomwise
