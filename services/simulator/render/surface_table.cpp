#include "services/simulator/render/surface_table.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace roomwise::simulator {
namespace {

void require(bool holds, const Scene& scene, const char* what) {
  if (!holds) throw std::runtime_error("scene " + scene.name + ": a mesh has " + what);
}

void check(const Scene& scene, const Mesh& mesh) {
  require(mesh.texture_m.size() == mesh.corners_m.size(), scene, "corners without texture");
  require(mesh.material >= 0 && static_cast<std::size_t>(mesh.material) < scene.materials.size(),
          scene, "no material");
  const auto is_finite = [](const auto& vector) { return vector.allFinite(); };
  require(std::all_of(mesh.corners_m.begin(), mesh.corners_m.end(), is_finite) &&
              std::all_of(mesh.texture_m.begin(), mesh.texture_m.end(), is_finite),
          scene, "a corner that is not finite");
  for (const auto& triangle : mesh.triangles) {
    const auto largest = *std::max_element(triangle.begin(), triangle.end());
    require(largest < mesh.corners_m.size(), scene, "a triangle without corner");
  }
}

bool is_same(const Surface& a, const Surface& b) {
  constexpr double kTolerance = 1e-6;  // corners come as single precision
  const double apart = (a.normal - b.normal).norm() + (a.s_gradient - b.s_gradient).norm() +
                       (a.t_gradient - b.t_gradient).norm() + std::abs(a.offset_m - b.offset_m) +
                       std::abs(a.s_at_origin_m - b.s_at_origin_m) +
                       std::abs(a.t_at_origin_m - b.t_at_origin_m);
  return apart < kTolerance && a.material == b.material && a.surface_class == b.surface_class;
}

}  // namespace

Surface make_surface(const Eigen::Matrix3d& corners_m,
                     const Eigen::Matrix<double, 2, 3>& texture_m) {
  const Eigen::Vector3d a = corners_m.col(1) - corners_m.col(0);
  const Eigen::Vector3d b = corners_m.col(2) - corners_m.col(0);
  const Eigen::Vector3d across = a.cross(b);
  Surface surface;
  if (across.norm() < 1e-12) return surface;
  surface.normal = across.normalized();
  surface.offset_m = surface.normal.dot(corners_m.col(0));
  // Gradients lie in the plane: g . a and g . b are the coordinate's differences, g . normal is 0.
  Eigen::Matrix3d rows;
  rows << a.transpose(), b.transpose(), surface.normal.transpose();
  const Eigen::Matrix3d inverse = rows.inverse();
  const auto gradient = [&](int i) -> Eigen::Vector3d {
    return inverse * Eigen::Vector3d(texture_m(i, 1) - texture_m(i, 0),
                                     texture_m(i, 2) - texture_m(i, 0), 0.0);
  };
  surface.s_gradient = gradient(0);
  surface.t_gradient = gradient(1);
  surface.s_at_origin_m = texture_m(0, 0) - surface.s_gradient.dot(corners_m.col(0));
  surface.t_at_origin_m = texture_m(1, 0) - surface.t_gradient.dot(corners_m.col(0));
  return surface;
}

Surface moved(const Surface& surface, const Eigen::Isometry3d& motion) {
  Surface result = surface;
  const Eigen::Vector3d shift = motion.translation();
  result.normal = motion.linear() * surface.normal;
  result.s_gradient = motion.linear() * surface.s_gradient;
  result.t_gradient = motion.linear() * surface.t_gradient;
  result.offset_m += result.normal.dot(shift);
  result.s_at_origin_m -= result.s_gradient.dot(shift);
  result.t_at_origin_m -= result.t_gradient.dot(shift);
  return result;
}

SurfaceTable::SurfaceTable(const Scene& scene) {
  add_part(scene, scene.meshes);
  for (const Walker& walker : scene.walkers) add_part(scene, walker.meshes);
  first_of_part_.push_back(static_cast<std::uint32_t>(surfaces_.size()));
  as_built_ = surfaces_;
}

void SurfaceTable::add_part(const Scene& scene, const std::vector<Mesh>& meshes) {
  first_of_part_.push_back(static_cast<std::uint32_t>(surfaces_.size()));
  for (const Mesh& mesh : meshes) {
    check(scene, mesh);
    add(mesh);
  }
}

void SurfaceTable::add(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    Eigen::Matrix3d corners_m;
    Eigen::Matrix<double, 2, 3> texture_m;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const std::uint32_t corner = triangle[static_cast<std::size_t>(i)];
      corners_m.col(i) = mesh.corners_m[corner].cast<double>();
      texture_m.col(i) = mesh.texture_m[corner].cast<double>();
    }
    Surface surface = make_surface(corners_m, texture_m);
    surface.material = static_cast<std::uint16_t>(mesh.material);
    surface.surface_class = mesh.surface_class;
    const bool continues = !surfaces_.empty() && is_same(surfaces_.back(), surface);
    flat_piece_.push_back(continues ? flat_piece_.back()
                                    : static_cast<std::uint32_t>(surfaces_.size()));
    surfaces_.push_back(surface);
  }
}

void SurfaceTable::move(std::size_t part, const Eigen::Isometry3d& T_world_part) {
  for (std::uint32_t i = first_of_part_[part]; i < first_of_part_[part + 1]; ++i) {
    surfaces_[i] = moved(as_built_[i], T_world_part);
  }
}

}  // namespace roomwise::simulator
