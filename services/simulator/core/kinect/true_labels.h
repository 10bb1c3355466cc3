#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "services/simulator/core/kinect/kinect_view.h"

namespace roomwise::simulator {

/// What a perfect segmentation of the frame would be, in the values of segmentation_t: 0 obstacle,
/// 50 drop-off, 100 wall, 200 accessible, 255 unknown where the sensor has no reading
/// (`depth_steps` is 0) or nothing stands there. Shapes: height x width. Throws
/// std::invalid_argument if sizes differ.
void true_labels(const KinectView& view, std::span<const std::uint16_t> depth_steps,
                 std::vector<std::uint8_t>& labels);

}  // namespace roomwise::simulator
