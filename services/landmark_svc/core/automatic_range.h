#pragma once
#include <optional>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/region_of_interest.h"

namespace roomwise::landmark {

/// Parts what is near from its background by the histogram of the depths in view, 5 cm a bin: the
/// threshold T that lies in the middle between the mean depth of what is nearer and of what is
/// farther, found by T <- (m1 + m2) / 2 from the mean of all. Looks at every fourth pixel of every
/// fourth row.
///
/// Nothing with fewer than 100 readings, or where all are in one bin.
///
/// Source: T. W. Ridler and S. Calvard, "Picture thresholding using an iterative selection method",
/// IEEE Trans. Systems, Man and Cybernetics 8 (1978).
std::optional<double> automatic_range_m(const DepthImage& depth, const DisparityTable& table,
                                        const PixelRectangle& region);

}  // namespace roomwise::landmark
