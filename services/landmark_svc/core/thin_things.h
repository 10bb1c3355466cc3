#pragma once
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/landmark.h"

namespace roomwise::landmark {

/// Makes one pole of the left and the right edge of something less than `width_max_m` wide: a leg,
/// a post, the stem of a lamp. Its centre lies half a width behind the nearest of its front, on the
/// line of sight between its edges: true of round and square things however they are turned. Of
/// what is flat the depth is unknown, so a quarter of the width is added to the sigma along.
///
/// The edges must overlap in height over half the shorter, and the surface between them must be
/// there: nearly all readings of the rows they share, within `width_max_m`. O(landmarks^2).
void join_thin_things(std::vector<Landmark>& landmarks, const DepthImage& depth,
                      const DisparityTable& table, double width_max_m);

}  // namespace roomwise::landmark
