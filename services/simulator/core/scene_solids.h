#pragma once
#include <Eigen/Core>
#include <vector>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// Triangles of one material together with their plans, in a frame of their own (z up, origin on
/// the floor) until moved() and add_to() put them into a world.
struct Solid {
  Mesh mesh;
  std::vector<Block> blocks;
  std::vector<Column> columns;
};

/// An axis-aligned box from `low_m` to `high_m`: closed, normals outward. Texture coordinates are
/// the box's own two coordinates along each face, so that boxes side by side share one pattern.
Solid box(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m);

/// An upright cylinder around the z axis: closed, normals outward, `sides` >= 3 flat faces whose
/// corners lie on the circle. Texture: way along the faces and height.
Solid cylinder(double radius_m, double low_m, double high_m, int sides = 24);

/// A rectangle at height z facing up (or down), less the axis-aligned rectangles `holes` (least and
/// largest corner each). It has no plan: there is floor wherever there is no pit.
Solid level_rectangle(const Eigen::Vector2d& least_m, const Eigen::Vector2d& largest_m, double z_m,
                      bool faces_up, const std::vector<Eigen::AlignedBox2d>& holes = {});

/// The four inner faces and the bottom of a rectangular pit below z = 0: open at the top.
Solid pit_lining(const Eigen::Vector2d& least_m, const Eigen::Vector2d& largest_m, double depth_m);

/// Triangles as given, corner counts in threes or indexed. Texture: x + y and z. Each triangle that
/// reaches up from the floor is an obstacle over all of its plan; none makes a landmark.
Solid triangle_mesh(const std::vector<Eigen::Vector3d>& corners_m,
                    const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Both in one; the material and class of `part` are lost.
void append(Solid& whole, const Solid& part);

/// `solid` turned about z, then shifted to (x, y) and lifted by `up_m`.
Solid moved(Solid solid, const Pose2& T_world_solid, double up_m = 0.0);

/// Puts the solid into the world with that material (index into scene.materials) and class.
void add_to(Scene& scene, Solid solid, int material, SurfaceClass surface_class);

}  // namespace roomwise::simulator
