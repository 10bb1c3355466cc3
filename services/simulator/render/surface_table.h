#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// A triangle's plane with everything that is linear on it. World frame.
struct Surface {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();     ///< unit length
  double offset_m = 0.0;                                 ///< normal . p for all p of the plane
  Eigen::Vector3d s_gradient = Eigen::Vector3d::Zero();  ///< of the first texture coordinate, m/m
  Eigen::Vector3d t_gradient = Eigen::Vector3d::Zero();
  double s_at_origin_m = 0.0;  ///< first texture coordinate at the world's origin
  double t_at_origin_m = 0.0;
  std::uint16_t material = 0;  ///< index into Scene::materials
  SurfaceClass surface_class = SurfaceClass::kObstacle;
};

/// The surface of one triangle. `corners_m` and `texture_m` of its three corners. A triangle
/// without area gives a plane that no ray hits.
Surface make_surface(const Eigen::Matrix3d& corners_m,
                     const Eigen::Matrix<double, 2, 3>& texture_m);

/// The same surface after it was moved.
Surface moved(const Surface& surface, const Eigen::Isometry3d& motion);

/// All triangles of a scene under one running number: first the meshes at rest, then each walker's.
class SurfaceTable {
 public:
  /// Throws std::runtime_error naming the scene if a mesh has a corner index, material or texture
  /// coordinate that does not exist, or a corner that is not finite.
  explicit SurfaceTable(const Scene& scene);

  /// Puts the triangles of `walker` where it is now.
  void move_walker(std::size_t walker, const Eigen::Isometry3d& T_world_walker);

  const Surface& operator[](std::uint32_t index) const { return surfaces_[index]; }
  std::size_t size() const { return surfaces_.size(); }
  /// Number of the first triangle of a mesh; meshes are counted as triangles are.
  std::uint32_t first_of_mesh(std::size_t mesh) const { return first_of_mesh_[mesh]; }
  /// Number of a walker's first mesh.
  std::size_t first_mesh_of_walker(std::size_t walker) const { return walker_meshes_[walker]; }

 private:
  void add(const Scene& scene, const Mesh& mesh);

  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> first_of_mesh_;
  std::vector<std::size_t> walker_meshes_;
  std::vector<Surface> walkers_at_origin_;  ///< as built: the tail of surfaces_
  std::size_t at_rest_ = 0;                 ///< how many come before the walkers'
};

}  // namespace roomwise::simulator
