#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "services/simulator/core/scene.h"
#include "services/simulator/render/ray_frame.h"
#include "services/simulator/render/surface_table.h"

namespace roomwise::simulator {

/// Which blocks of an image no edge of any flat piece crosses, hidden ones included.
///
/// In such a block every flat piece covers either all pixels or none. Among those that cover it the
/// nearest is the same throughout if it is at the four corners, because differences of inverse
/// depth are linear in the pixel: four rays tell what all pixels of the block show.
class EdgeBlocks {
 public:
  static constexpr int kSide_px = 8;

  EdgeBlocks(const Scene& scene, const SurfaceTable& table);

  /// Puts a part of the scene, as SurfaceTable counts them, where it is now.
  void move(std::size_t part, const Eigen::Isometry3d& T_world_part);

  /// Marks the blocks of an image. Allocates nothing after the first of a size.
  void mark(const RayFrame& rays, int width_px, int height_px);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Whether an edge, or the border of the image, may cross the block.
  bool has_edge(int column, int row) const {
    return marks_[static_cast<std::size_t>(row * columns_ + column)] != 0;
  }
  /// Says of a block that it has to be looked at pixel by pixel all the same.
  void add_edge(int column, int row) {
    marks_[static_cast<std::size_t>(row * columns_ + column)] = 1;
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;

  void add_part(const std::vector<Mesh>& meshes, const SurfaceTable& table, std::uint32_t triangle);
  void mark_edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
  void mark_segment(Eigen::Vector2d a_px, Eigen::Vector2d b_px);
  void mark_blocks(double u_px, double other_u_px, int row);

  std::vector<Eigen::Vector3d> as_built_m_;  ///< corners, each place once in a part
  std::vector<Eigen::Vector3d> corners_m_;   ///< where they are now
  std::vector<Eigen::Vector3d> seen_;        ///< (u z, v z, z) in the image, z being depth in m
  std::vector<Edge> edges_;                  ///< indices of corners
  std::vector<std::size_t> first_of_part_;   ///< corner; and, at the end, how many there are
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> marks_;
};

}  // namespace roomwise::simulator
