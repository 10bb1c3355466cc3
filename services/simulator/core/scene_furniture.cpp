#include "services/simulator/core/scene_furniture.h"

#include <algorithm>

namespace roomwise::simulator {
namespace {

/// A box standing on z = low: centre of its plan, sizes along x and y, then where it begins and
/// ends.
Solid block_at(double x_m, double y_m, double along_x_m, double along_y_m, double low_m,
               double high_m) {
  return box({x_m - along_x_m / 2, y_m - along_y_m / 2, low_m},
             {x_m + along_x_m / 2, y_m + along_y_m / 2, high_m});
}

Solid column_at(double x_m, double y_m, double radius_m, double low_m, double high_m) {
  return moved(cylinder(radius_m, low_m, high_m), {x_m, y_m, 0.0});
}

/// Legs set a little inward, as a carpenter would.
void append_legs(Solid& solid, const Eigen::Vector3d& size_m, double leg_m, double high_m) {
  constexpr double kInset_m = 0.02;
  const Eigen::Vector2d out_m = (size_m.head<2>().array() - leg_m) / 2 - kInset_m;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      append(solid, block_at(x * out_m.x(), y * out_m.y(), leg_m, leg_m, 0.0, high_m));
    }
  }
}

}  // namespace

Solid wall(double length_m, double thickness_m, double height_m,
           const std::vector<Opening>& openings) {
  std::vector<Opening> sorted = openings;
  std::sort(sorted.begin(), sorted.end(),
            [](const Opening& a, const Opening& b) { return a.from_m < b.from_m; });
  Solid solid;
  const auto add = [&](double from_m, double to_m, double low_m, double high_m) {
    if (to_m <= from_m || high_m <= low_m) return;
    append(solid, box({from_m, -thickness_m / 2, low_m}, {to_m, thickness_m / 2, high_m}));
  };
  double done_m = 0.0;
  for (const Opening& gap : sorted) {
    add(done_m, gap.from_m, 0.0, height_m);
    add(gap.from_m, gap.to_m, 0.0, gap.sill_m);
    add(gap.from_m, gap.to_m, gap.head_m, height_m);
    done_m = gap.to_m;
  }
  add(done_m, length_m, 0.0, height_m);
  return solid;
}

Solid table(const Eigen::Vector3d& size_m, double top_thickness_m, double leg_m) {
  Solid solid;
  const double underside_m = size_m.z() - top_thickness_m;
  append_legs(solid, size_m, leg_m, underside_m);
  append(solid, block_at(0.0, 0.0, size_m.x(), size_m.y(), underside_m, size_m.z()));
  return solid;
}

Solid chair(const Eigen::Vector3d& size_m, double leg_m) {
  Solid solid = table({size_m.x(), size_m.y(), size_m.z() / 2}, leg_m, leg_m);
  append(solid,
         block_at((leg_m - size_m.x()) / 2, 0.0, leg_m, size_m.y(), size_m.z() / 2, size_m.z()));
  return solid;
}

Solid sofa(const Eigen::Vector3d& size_m) {
  const double arm_m = std::min(0.2, size_m.y() / 6);
  const double back_m = std::min(0.22, size_m.x() / 3);
  const double seat_width_m = size_m.y() - 2 * arm_m;
  Solid solid = block_at((back_m - size_m.x()) / 2, 0.0, back_m, seat_width_m, 0.0, size_m.z());
  append(solid,
         block_at(back_m / 2, 0.0, size_m.x() - back_m, seat_width_m, 0.0, 0.5 * size_m.z()));
  for (const double y : {-1.0, 1.0}) {
    append(solid,
           block_at(0.0, y * (size_m.y() - arm_m) / 2, size_m.x(), arm_m, 0.0, 0.75 * size_m.z()));
  }
  return solid;
}

Solid shelf(const Eigen::Vector3d& size_m, int boards) {
  constexpr double kBoard_m = 0.03;
  const double inner_m = size_m.y() - 2 * kBoard_m;
  Solid solid;
  for (const double y : {-1.0, 1.0}) {
    append(solid,
           block_at(0.0, y * (size_m.y() - kBoard_m) / 2, size_m.x(), kBoard_m, 0.0, size_m.z()));
  }
  append(solid, block_at((kBoard_m - size_m.x()) / 2, 0.0, kBoard_m, inner_m, 0.0, size_m.z()));
  for (int i = 0; i < boards; ++i) {
    const double low_m = i * (size_m.z() - kBoard_m) / (boards - 1);
    append(solid,
           block_at(kBoard_m / 2, 0.0, size_m.x() - kBoard_m, inner_m, low_m, low_m + kBoard_m));
  }
  return solid;
}

Solid steps_up(int steps, double tread_m, double riser_m, double width_m) {
  Solid solid;
  for (int i = 0; i < steps; ++i) {
    append(solid, box({i * tread_m, -width_m / 2, i * riser_m},
                      {steps * tread_m, width_m / 2, (i + 1) * riser_m}));
  }
  return solid;
}

Solid steps_down(int steps, double tread_m, double riser_m, double width_m, double depth_m) {
  Solid solid;
  for (int i = 0; i < steps; ++i) {
    append(solid, box({i * tread_m, -width_m / 2, -depth_m},
                      {(i + 1) * tread_m, width_m / 2, -(i + 1) * riser_m}));
  }
  return solid;
}

PersonParts person(double height_m) {
  const double hip_m = 0.48 * height_m;
  const double shoulder_m = 0.82 * height_m;
  PersonParts parts;
  for (const double y_m : {-0.09, 0.09}) {
    append(parts.legs, column_at(0.0, y_m, 0.07, 0.0, hip_m));
    append(parts.body, column_at(0.0, y_m * 2.6, 0.045, hip_m, shoulder_m));
  }
  append(parts.body, block_at(0.0, 0.0, 0.22, 0.36, hip_m, shoulder_m));
  append(parts.head, column_at(0.0, 0.0, 0.06, shoulder_m, 0.87 * height_m));
  append(parts.head, column_at(0.0, 0.0, 0.095, 0.87 * height_m, height_m));
  return parts;
}

}  // namespace roomwise::simulator
