#pragma once
#include <cstdint>

#include "services/ekf_svc/core/body_observation.h"
#include "services/ekf_svc/core/landmark.h"
#include "services/ekf_svc/core/residual.h"

namespace roomwise::ekf {

// An outline, the end of a surface as the camera sees it, is the corner of a thing with a
// thickness: of a door leaf, a wall's end, half of a chair leg. Which corner, and what of its side
// is taken for its front, depends on where it is seen from. So its errors repeat.

/// landmark_observation_t.KIND_EDGE_LEFT and _RIGHT.
constexpr bool is_outline(std::int8_t kind) { return kind == 1 || kind == 2; }

/// How far beyond its place in the map a landmark is seen, after `travel_m` of way. `chord`: the
/// residual as the filter gives it.
RangeOff range_off(const Residual& chord, const BodyObservation& seen, double travel_m);

/// Whether it may be the same outline that is seen again. It can be centimetres off, so the gate
/// must be wide; but a little way on it is off by about as much again: within 3 cm and a tenth of
/// the way, both at 3 sigma. Corners that stand behind one another in one line of sight are told
/// apart by that. After 2 m nothing is asked.
bool repeats(const RangeOff& before, const RangeOff& now);

/// Whether `landmark` may be what is seen that far off: only outlines are asked to repeat.
bool may_be(const Landmark& landmark, const RangeOff& now);

/// What to add to an outline's noise, for the correction alone, when it is seen from `turned_rad`
/// beside where it was first seen from: another corner may be the outline from there, farther off
/// by `shift_m_per_rad` a radian at one sigma. 0 where the first direction is not known (not a
/// number).
Eigen::Matrix2d turned_softening(double turned_rad, double shift_m_per_rad);

}  // namespace roomwise::ekf
