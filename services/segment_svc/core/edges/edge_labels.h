#pragma once
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/color/color_table.h"
#include "services/segment_svc/core/edges/borders.h"

namespace roomwise::segment {

/// Number of the region of each pixel (height x width), from 0: pixels that can be joined without
/// crossing a border.
std::vector<int> regions_between(const CrackEdges& edges, const std::vector<Border>& borders);

/// Segmentation by edges (thesis, section 4.2): cracks of the grey image, relaxed; borders traced
/// along them and continued over gaps by the cheapest way; each region between borders gets the
/// class of its mean colour. Depth plays no part. Worked out on an image of 160 columns; some tens
/// of milliseconds a frame, and memory is allocated: for teaching and comparison. Labels are
/// `height_px` x `width_px`; the colour image must not be empty.
std::vector<std::uint8_t> label_by_edges(const ColorImage& color, const ColorTable& table,
                                         int width_px, int height_px);

}  // namespace roomwise::segment
