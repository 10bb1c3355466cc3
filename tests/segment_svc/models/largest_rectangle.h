#pragma once
#include <cstdint>
#include <vector>

#include "services/segment_svc/core/color/training.h"

namespace roomwise::segment {

/// The largest rectangle that holds nothing but `label`, of an image of labels (height x width):
/// what a person would drag over a class. Without area where there is no such pixel.
TrainingRectangle largest_rectangle(const std::vector<std::uint8_t>& labels, int width_px,
                                    int height_px, int label);

}  // namespace roomwise::segment
