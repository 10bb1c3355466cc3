#pragma once
#include "services/ekf_svc/core/residual.h"

namespace roomwise::ekf {

/// What to add to the noise of a sighting for its correction, so that a range which is d > `sigmas`
/// standard deviations off pulls as hard as one that is `sigmas` off, and no harder: its variance
/// times d / sigmas, along the line of sight alone. Ranges have outliers (an edge's mixed pixels, a
/// marker half seen); bearings are good whatever the range is, and tell first of a slipped wheel.
///
/// `p_robot_m`: where it was seen. `S`: covariance of the innovation. `sigmas` 0: nothing is added.
/// Source: Huber, "Robust estimation of a location parameter", Ann. Math. Statist. 35, 1964.
Eigen::Matrix2d range_softening(const Residual& residual, const Eigen::Vector2d& p_robot_m,
                                const Eigen::Matrix2d& S, double sigmas);

}  // namespace roomwise::ekf
