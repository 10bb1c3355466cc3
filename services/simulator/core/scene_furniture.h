#pragma once
#include <Eigen/Core>
#include <vector>

#include "services/simulator/core/scene_solids.h"

namespace roomwise::simulator {

/// A gap in a wall: a door (sill_m = 0) or a window.
struct Opening {
  double from_m = 0.0;  ///< along the wall from its first end
  double to_m = 0.0;
  double sill_m = 0.0;
  double head_m = 0.0;  ///< upper end of the gap
};

/// A wall along x from 0 to `length_m`, its thickness half to either side, as boxes around its
/// openings. The openings must lie within the wall and not overlap.
Solid wall(double length_m, double thickness_m, double height_m,
           const std::vector<Opening>& openings);

/// A table top of `size_m` (x, y, height of its upper face) on four square legs, centred.
Solid table(const Eigen::Vector3d& size_m, double top_thickness_m, double leg_m);

/// A seat at half of the height (x, y, upper end of the back) on four legs, with a back at -x.
Solid chair(const Eigen::Vector3d& size_m, double leg_m);

/// Seat, back at -x and two arms, all down to the floor, centred. size: depth, width, height.
Solid sofa(const Eigen::Vector3d& size_m);

/// Boards and sides of an open bookcase against its back at -x. size: depth, width, height.
Solid shelf(const Eigen::Vector3d& size_m, int boards);

/// Closed steps that rise along +x from the origin, centred in y; volume
/// tread riser width steps (steps + 1) / 2.
Solid steps_up(int steps, double tread_m, double riser_m, double width_m);

/// Steps that sink along +x from the origin into a pit `depth_m` deep: the first tread lies one
/// riser below z = 0. Requires steps * riser_m < depth_m.
Solid steps_down(int steps, double tread_m, double riser_m, double width_m, double depth_m);

/// A standing person, facing x, of three materials: legs, body with arms, head.
struct PersonParts {
  Solid legs;
  Solid body;
  Solid head;
};
PersonParts person(double height_m);

}  // namespace roomwise::simulator
