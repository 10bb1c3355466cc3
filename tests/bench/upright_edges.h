#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise {

/// What an edge picture would make of a landmark: each connected component of `edges` (8 bits, as
/// large as the depth image, not 0: edge) that is upright, 18 rows of 480 or more and four times as
/// high as wide, placed in the column of its centre at the median of the nearest depths beside its
/// rows. [m], robot frame, in the floor plane.
std::vector<Eigen::Vector2d> upright_edges_m(const cv::Mat& edges, const RgbdFrame& frame);

}  // namespace roomwise
