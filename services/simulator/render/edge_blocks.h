#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "services/simulator/core/scene.h"
#include "services/simulator/render/ray_frame.h"
#include "services/simulator/render/surface_table.h"

namespace roomwise::simulator {

/// Which square blocks of an image no edge of any flat piece crosses, hidden ones included. Blocks
/// come in levels, each half the side of the one before.
///
/// In a block without an edge every flat piece covers either all pixels or none. Among those that
/// cover it the nearest is the same throughout if it is at the four corners, because differences of
/// inverse depth are linear in the pixel: four rays tell what all pixels of the block show.
class EdgeBlocks {
 public:
  static constexpr int kLevels = 4;
  static constexpr int kFinest = kLevels - 1;
  /// 32, 16, 8 and 4.
  static constexpr int side_px(int level) { return 32 >> level; }

  EdgeBlocks(const Scene& scene, const SurfaceTable& table);

  /// Puts a part of the scene, as SurfaceTable counts them, where it is now.
  void move(std::size_t part, const Eigen::Isometry3d& T_world_part);

  /// Marks the blocks of an image. Allocates nothing after the first of a size.
  void mark(const RayFrame& rays, int width_px, int height_px);

  int columns(int level) const { return at(level).columns; }
  int rows(int level) const { return at(level).rows; }
  /// Whether an edge, or the border of the image, may cross the block.
  bool has_edge(int level, int column, int row) const {
    const Level& blocks = at(level);
    return blocks.marks[static_cast<std::size_t>(row * blocks.columns + column)] != 0;
  }
  /// Says of a block that its corners do not tell all of it: its parts have to be looked at.
  void add_edge(int level, int column, int row) { mark_block(at(level), column, row); }

 private:
  using Edge = std::array<std::uint32_t, 2>;
  struct Level {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint8_t> marks;
  };

  const Level& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }
  Level& at(int level) { return levels_[static_cast<std::size_t>(level)]; }
  static void mark_block(Level& level, int column, int row) {
    level.marks[static_cast<std::size_t>(row * level.columns + column)] = 1;
  }

  void add_part(const std::vector<Mesh>& meshes, const SurfaceTable& table, std::uint32_t triangle);
  void clear(int width_px, int height_px);
  void pass_up();
  void mark_edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
  void mark_segment(Eigen::Vector2d a_px, Eigen::Vector2d b_px);
  void mark_tiles(double u_px, double other_u_px, int row);

  std::vector<Eigen::Vector3d> as_built_m_;  ///< corners, each place once in a part
  std::vector<Eigen::Vector3d> corners_m_;   ///< where they are now
  std::vector<Eigen::Vector3d> seen_;        ///< (u z, v z, z) in the image, z being depth in m
  std::vector<Edge> edges_;                  ///< indices of corners
  std::vector<std::size_t> first_of_part_;   ///< corner; and, at the end, how many there are
  std::array<Level, kLevels> levels_;        ///< of blocks, row by row
};

}  // namespace roomwise::simulator
