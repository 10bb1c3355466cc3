#pragma once
#include <OpenNI.h>

#include "common/image/rgbd_frame.h"

namespace roomwise {

/// Copies an image out of OpenNI2's memory, turned back if `mirrored`. False, leaving `depth`
/// unspecified, if its format is not 1 mm or 100 um depth or its sizes do not fit its data.
bool copy_depth(const openni::VideoFrameRef& image, bool mirrored, DepthImage& depth);

/// The same for RGB888 colour.
bool copy_color(const openni::VideoFrameRef& image, bool mirrored, ColorImage& color);

}  // namespace roomwise
