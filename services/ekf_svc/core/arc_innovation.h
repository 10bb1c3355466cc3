#pragma once
#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

/// A sighting's residual for a robot whose heading is little known. The straight line from where
/// the landmark should be to where it is seen is then the chord of an arc round the robot: turning
/// by e moves it r e along the arc, and the chord's r (1 - cos e) towards the robot is no error of
/// the range at all, though it may be many of its standard deviations. So where the bearing is off
/// by more than 0.1 rad, and what is known of the landmark's place in the robot frame is less
/// across the line of sight than along it, the innovation is unrolled:
///   (|z| - |h|) along the line of sight to the predicted place h, and |h| (angle z - angle h)
/// across it; the noise turns with it. H stays: it is the arc's tangent at h.
Residual unrolled(const SlamFilter& filter, const Residual& residual, const BodyObservation& seen);

}  // namespace roomwise::ekf
