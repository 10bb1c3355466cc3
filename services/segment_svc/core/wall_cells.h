#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/floor_plane.h"

namespace roomwise::segment {

/// Finds walls among the pixels labelled obstacle: upright planes more than 0.5 m wide and 0.6 m
/// high.
///
/// The image is cut into cells of 16 x 16 pixels. On a plane the inverse depth is linear in pixel
/// coordinates, 1/z = m . (x, y, 1) with m the plane's normal over its distance; each cell gets
/// that fit by least squares over its obstacle pixels. Neighbouring flat, upright cells of one
/// plane are joined, and what is large enough is a wall; so are the obstacle pixels of the cells
/// beside it that lie on its plane, down to where the plane meets the floor.
class WallCells {
 public:
  /// Turns obstacle labels of wall cells into wall labels.
  void mark(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
            std::vector<std::uint8_t>& labels);

 private:
  struct Cell {
    bool is_upright = false;
    int patch = -1;
    Eigen::Vector3f m;           ///< plane: m . p = 1
    Eigen::Vector3f p_camera_m;  ///< of its middle
  };
  /// Of the obstacle pixels looked at in one row of cells, by image column.
  struct ColumnSums {
    std::vector<float> n, ny, nyy, w, wy, ww;
  };
  static std::size_t middle_row(const CameraView& view, int row);
  void sum_columns(const RgbdFrame& frame, const CameraView& view,
                   const std::vector<std::uint8_t>& labels, int row);
  Cell fit(const CameraView& view, const FloorPlane& floor, int column, int row) const;
  void join(const FloorPlane& floor);
  void grow(std::size_t start, int patch);
  bool is_wall(const FloorPlane& floor) const;
  bool are_one_plane(const Cell& a, const Cell& b) const;
  bool is_wall_cell(int column, int row) const;
  /// Of floor pixels that lie on a wall's plane too.
  enum class Foot : std::uint8_t { kIsWall, kStaysFloor };
  void relabel(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
               std::vector<std::uint8_t>& labels) const;
  template <class Relabel>
  void close_holes(int row, const Relabel& relabel) const;
  void relabel_cell(const RgbdFrame& frame, const CameraView& view, int column, int row,
                    const Eigen::Vector3f& plane_m, const Eigen::Vector3f& floor_m, Foot foot,
                    std::vector<std::uint8_t>& labels) const;

  float quantum_per_m_ = 0.0F;
  int columns_ = 0;
  int rows_ = 0;
  ColumnSums sums_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> members_;  // of the patch being grown
  std::vector<char> patch_is_wall_;
};

}  // namespace roomwise::segment
