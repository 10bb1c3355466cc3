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

/// All triangles of a scene under one running number, part by part: the meshes at rest are part 0,
/// walker i is part i + 1.
class SurfaceTable {
 public:
  /// Throws std::runtime_error naming the scene if a mesh has a corner index, material or texture
  /// coordinate that does not exist, or a corner that is not finite.
  explicit SurfaceTable(const Scene& scene);

  /// Puts the triangles of a walker's part where it is now.
  void move(std::size_t part, const Eigen::Isometry3d& T_world_part);

  const Surface& operator[](std::uint32_t triangle) const { return surfaces_[triangle]; }
  /// The first of the triangles that make one flat piece with this one and look the same.
  std::uint32_t flat_piece(std::uint32_t triangle) const { return flat_piece_[triangle]; }
  std::uint32_t first_of_part(std::size_t part) const { return first_of_part_[part]; }

 private:
  void add_part(const Scene& scene, const std::vector<Mesh>& meshes);
  void add(const Mesh& mesh);

  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> flat_piece_;
  std::vector<std::uint32_t> first_of_part_;  ///< and, at the end, how many there are
  std::vector<Surface> as_built_;             ///< before any part was moved
};

}  // namespace roomwise::simulator
