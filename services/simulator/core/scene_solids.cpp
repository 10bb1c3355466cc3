#include "services/simulator/core/scene_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace roomwise::simulator {
namespace {

using Corners = std::array<Eigen::Vector3d, 4>;

/// A flat quadrangle, counter-clockwise seen from outside. `u` and `v`: which coordinates of a
/// corner are its texture.
void add_quad(Mesh& mesh, const Corners& corners_m, int u, int v) {
  const auto first = static_cast<std::uint32_t>(mesh.corners_m.size());
  for (const Eigen::Vector3d& corner : corners_m) {
    mesh.corners_m.push_back(corner.cast<float>());
    mesh.texture_m.emplace_back(static_cast<float>(corner[u]), static_cast<float>(corner[v]));
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

Corners reversed(const Corners& c) { return {c[3], c[2], c[1], c[0]}; }

/// The face of a box at its lower (or upper) end along `axis`, normal outward.
Corners box_face(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m, int axis,
                 bool upper) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Corners corners;
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector3d& corner = corners[static_cast<std::size_t>(i)];
    corner[axis] = upper ? high_m[axis] : low_m[axis];
    corner[u] = i == 1 || i == 2 ? high_m[u] : low_m[u];
    corner[v] = i >= 2 ? high_m[v] : low_m[v];
  }
  return upper ? corners : reversed(corners);
}

void add_box_face(Mesh& mesh, const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m, int axis,
                  bool upper) {
  constexpr std::array<std::array<int, 2>, 3> kTexture{{{1, 2}, {0, 2}, {0, 1}}};
  const auto& [u, v] = kTexture[static_cast<std::size_t>(axis)];
  add_quad(mesh, box_face(low_m, high_m, axis, upper), u, v);
}

std::uint32_t add_corner(Mesh& mesh, const Eigen::Vector3d& corner_m, double u_m, double v_m) {
  mesh.corners_m.push_back(corner_m.cast<float>());
  mesh.texture_m.emplace_back(static_cast<float>(u_m), static_cast<float>(v_m));
  return static_cast<std::uint32_t>(mesh.corners_m.size() - 1);
}

Eigen::Vector3d on_circle(double radius_m, int side, int sides, double z_m) {
  // The last side ends where the first began, to the bit: otherwise the cylinder would leak.
  const double angle_rad = 2.0 * std::numbers::pi * (side % sides) / sides;
  return {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m};
}

void add_cylinder_side(Mesh& mesh, const std::array<Eigen::Vector3d, 4>& corners_m, double u0_m,
                       double u1_m) {
  const std::uint32_t a = add_corner(mesh, corners_m[0], u0_m, corners_m[0].z());
  const std::uint32_t b = add_corner(mesh, corners_m[1], u1_m, corners_m[1].z());
  const std::uint32_t c = add_corner(mesh, corners_m[2], u1_m, corners_m[2].z());
  const std::uint32_t d = add_corner(mesh, corners_m[3], u0_m, corners_m[3].z());
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// One slice of the cylinder's lid at height z, facing up or down.
void add_slice(Mesh& mesh, const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m, bool faces_up) {
  const Eigen::Vector3d center_m(0.0, 0.0, a_m.z());
  const auto add = [&mesh](const Eigen::Vector3d& p) { return add_corner(mesh, p, p.x(), p.y()); };
  const std::uint32_t center = add(center_m);
  const std::uint32_t first = add(faces_up ? a_m : b_m);
  mesh.triangles.push_back({center, first, add(faces_up ? b_m : a_m)});
}

std::vector<double> cuts_between(double least, double largest, std::vector<double> cuts) {
  std::erase_if(cuts, [&](double cut) { return !(cut > least && cut < largest); });
  cuts.push_back(least);
  cuts.push_back(largest);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

std::vector<double> hole_cuts(const std::vector<Eigen::AlignedBox2d>& holes, int axis) {
  std::vector<double> cuts;
  for (const Eigen::AlignedBox2d& hole : holes) {
    cuts.push_back(hole.min()[axis]);
    cuts.push_back(hole.max()[axis]);
  }
  return cuts;
}

bool in_any(const std::vector<Eigen::AlignedBox2d>& holes, const Eigen::Vector2d& p_m) {
  return std::any_of(holes.begin(), holes.end(),
                     [&](const Eigen::AlignedBox2d& hole) { return hole.contains(p_m); });
}

/// The plan of a triangle, counter-clockwise.
Block triangle_plan(const std::array<Eigen::Vector3d, 3>& corners_m) {
  Block plan;
  for (const Eigen::Vector3d& corner : corners_m) plan.corners_m.emplace_back(corner.head<2>());
  const Eigen::Vector2d ab = plan.corners_m[1] - plan.corners_m[0];
  const Eigen::Vector2d ac = plan.corners_m[2] - plan.corners_m[0];
  if (ab.x() * ac.y() - ab.y() * ac.x() < 0.0) std::swap(plan.corners_m[1], plan.corners_m[2]);
  plan.low_m = std::min({corners_m[0].z(), corners_m[1].z(), corners_m[2].z()});
  plan.high_m = std::max({corners_m[0].z(), corners_m[1].z(), corners_m[2].z()});
  plan.has_landmarks = false;
  return plan;
}

}  // namespace

Solid box(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m) {
  Solid solid;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      add_box_face(solid.mesh, low_m, high_m, axis, upper);
    }
  }
  solid.blocks.push_back(
      {{low_m.head<2>(), {high_m.x(), low_m.y()}, high_m.head<2>(), {low_m.x(), high_m.y()}},
       low_m.z(),
       high_m.z()});
  return solid;
}

Solid cylinder(double radius_m, double low_m, double high_m, int sides) {
  Solid solid;
  const double side_m = 2.0 * radius_m * std::sin(std::numbers::pi / sides);
  for (int i = 0; i < sides; ++i) {
    const Eigen::Vector3d a = on_circle(radius_m, i, sides, low_m);
    const Eigen::Vector3d b = on_circle(radius_m, i + 1, sides, low_m);
    const Eigen::Vector3d c = on_circle(radius_m, i + 1, sides, high_m);
    const Eigen::Vector3d d = on_circle(radius_m, i, sides, high_m);
    add_cylinder_side(solid.mesh, {a, b, c, d}, i * side_m, (i + 1) * side_m);
    add_slice(solid.mesh, a, b, false);
    add_slice(solid.mesh, d, c, true);
  }
  solid.columns.push_back({Eigen::Vector2d::Zero(), radius_m, low_m, high_m});
  return solid;
}

Solid level_rectangle(const Eigen::Vector2d& least_m, const Eigen::Vector2d& largest_m, double z_m,
                      bool faces_up, const std::vector<Eigen::AlignedBox2d>& holes) {
  Solid solid;
  const auto xs = cuts_between(least_m.x(), largest_m.x(), hole_cuts(holes, 0));
  const auto ys = cuts_between(least_m.y(), largest_m.y(), hole_cuts(holes, 1));
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      if (in_any(holes, {(xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2})) continue;
      add_box_face(solid.mesh, {xs[i], ys[j], z_m}, {xs[i + 1], ys[j + 1], z_m}, 2, faces_up);
    }
  }
  return solid;
}

Solid pit_lining(const Eigen::Vector2d& least_m, const Eigen::Vector2d& largest_m, double depth_m) {
  const Eigen::Vector3d low_m(least_m.x(), least_m.y(), -depth_m);
  const Eigen::Vector3d high_m(largest_m.x(), largest_m.y(), 0.0);
  Solid solid;
  for (const int axis : {0, 1}) {
    for (const bool upper : {false, true}) {
      add_quad(solid.mesh, reversed(box_face(low_m, high_m, axis, upper)), 1 - axis, 2);
    }
  }
  add_quad(solid.mesh, reversed(box_face(low_m, high_m, 2, false)), 0, 1);
  return solid;
}

Solid triangle_mesh(const std::vector<Eigen::Vector3d>& corners_m,
                    const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Solid solid;
  for (const Eigen::Vector3d& p : corners_m) add_corner(solid.mesh, p, p.x() + p.y(), p.z());
  solid.mesh.triangles = triangles;
  for (const auto& [a, b, c] : triangles) {
    solid.blocks.push_back(triangle_plan({corners_m[a], corners_m[b], corners_m[c]}));
  }
  return solid;
}

void append(Solid& whole, const Solid& part) {
  const auto first = static_cast<std::uint32_t>(whole.mesh.corners_m.size());
  const auto extend = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  extend(whole.mesh.corners_m, part.mesh.corners_m);
  extend(whole.mesh.texture_m, part.mesh.texture_m);
  for (const auto& [a, b, c] : part.mesh.triangles) {
    whole.mesh.triangles.push_back({first + a, first + b, first + c});
  }
  extend(whole.blocks, part.blocks);
  extend(whole.columns, part.columns);
}

Solid moved(Solid solid, const Pose2& T_world_solid, double up_m) {
  for (Eigen::Vector3f& corner : solid.mesh.corners_m) {
    const Eigen::Vector3d p = corner.cast<double>();
    const Eigen::Vector2d plan = transform(T_world_solid, p.head<2>());
    corner = Eigen::Vector3d(plan.x(), plan.y(), p.z() + up_m).cast<float>();
  }
  for (Block& block : solid.blocks) {
    for (Eigen::Vector2d& corner : block.corners_m) corner = transform(T_world_solid, corner);
    block.low_m += up_m;
    block.high_m += up_m;
  }
  for (Column& column : solid.columns) {
    column.center_m = transform(T_world_solid, column.center_m);
    column.low_m += up_m;
    column.high_m += up_m;
  }
  return solid;
}

void add_to(Scene& scene, Solid solid, int material, SurfaceClass surface_class) {
  solid.mesh.material = material;
  solid.mesh.surface_class = surface_class;
  scene.meshes.push_back(std::move(solid.mesh));
  scene.blocks.insert(scene.blocks.end(), solid.blocks.begin(), solid.blocks.end());
  scene.columns.insert(scene.columns.end(), solid.columns.begin(), solid.columns.end());
}

}  // namespace roomwise::simulator
