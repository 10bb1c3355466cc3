#pragma once
#include <cstdint>

#include "common/image/rgbd_frame.h"

namespace roomwise {

/// Blanks what the projector, beside the camera, does not light: next to the right of a near
/// surface a strip as wide as the difference in disparity, in pixels.
void add_projector_shadow(DepthImage& depth, double quanta_m);

/// Shifts short runs of rows sideways by up to a pixel, as matching over blocks of pixels does.
void add_ragged_edges(DepthImage& depth, std::uint32_t seed);

/// Blanks `share` of all pixels, in short runs.
void add_dropouts(DepthImage& depth, double share, std::uint32_t seed);

/// Left and right swapped: depth, colour and principal point.
RgbdFrame mirrored(const RgbdFrame& frame);

/// Depth of a plane, disparity = quanta + du u + dv v (quanta), as the sensor rounds it; an error
/// of up to `noise_quanta` is added before. Readings beyond 4 m or nearer than 0.5 m are 0.
DepthImage plane_image(int width_px, int height_px, double quanta, double du, double dv,
                       double noise_quanta, std::uint32_t seed);

}  // namespace roomwise
