#include "services/simulator/render/edge_blocks.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace roomwise::simulator {
namespace {

constexpr double kNearest_m = 1e-3;
/// Rays are of single precision, and so are the corners Embree has.
constexpr double kMargin_px = 0.5;
constexpr int kFinest_px = EdgeBlocks::side_px(EdgeBlocks::kFinest);

/// Corners by place: faces that share a place share its number.
class CornerNumbers {
 public:
  explicit CornerNumbers(std::vector<Eigen::Vector3d>& corners_m) : corners_m_(corners_m) {}

  std::uint32_t operator()(const Eigen::Vector3f& p_m) {
    const auto next = static_cast<std::uint32_t>(corners_m_.size());
    const auto [entry, is_new] = numbers_.try_emplace({p_m.x(), p_m.y(), p_m.z()}, next);
    if (is_new) corners_m_.push_back(p_m.cast<double>());
    return entry->second;
  }

 private:
  std::map<std::array<float, 3>, std::uint32_t> numbers_;
  std::vector<Eigen::Vector3d>& corners_m_;
};

}  // namespace

EdgeBlocks::EdgeBlocks(const Scene& scene, const SurfaceTable& table) {
  add_part(scene.meshes, table, table.first_of_part(0));
  for (std::size_t i = 0; i < scene.walkers.size(); ++i) {
    add_part(scene.walkers[i].meshes, table, table.first_of_part(i + 1));
  }
  first_of_part_.push_back(as_built_m_.size());
  corners_m_ = as_built_m_;
  seen_.resize(corners_m_.size());
}

void EdgeBlocks::add_part(const std::vector<Mesh>& meshes, const SurfaceTable& table,
                          std::uint32_t triangle) {
  first_of_part_.push_back(as_built_m_.size());
  CornerNumbers number(as_built_m_);
  // How many triangles of a flat piece have this edge: two, and it is inside the piece.
  std::map<std::pair<Edge, std::uint32_t>, int> count;
  for (const Mesh& mesh : meshes) {
    for (const auto& corners : mesh.triangles) {
      const std::uint32_t piece = table.flat_piece(triangle++);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = number(mesh.corners_m[corners[i]]);
        const std::uint32_t b = number(mesh.corners_m[corners[(i + 1) % 3]]);
        ++count[{Edge{std::min(a, b), std::max(a, b)}, piece}];
      }
    }
  }
  for (const auto& [edge_of_piece, triangles] : count) {
    const bool is_known = !edges_.empty() && edges_.back() == edge_of_piece.first;
    if (triangles == 1 && !is_known) edges_.push_back(edge_of_piece.first);
  }
}

void EdgeBlocks::move(std::size_t part, const Eigen::Isometry3d& T_world_part) {
  for (std::size_t i = first_of_part_[part]; i < first_of_part_[part + 1]; ++i) {
    corners_m_[i] = T_world_part * as_built_m_[i];
  }
}

void EdgeBlocks::clear(int width_px, int height_px) {
  for (int i = 0; i < kLevels; ++i) {
    const int side = side_px(i);
    Level& level = at(i);
    level.columns = (width_px + side - 1) / side;
    level.rows = (height_px + side - 1) / side;
    level.marks.assign(static_cast<std::size_t>(level.columns * level.rows), 0);
    // What reaches beyond the image is never taken as a whole.
    for (int row = 0; width_px % side != 0 && row < level.rows; ++row)
      mark_block(level, level.columns - 1, row);
    for (int column = 0; height_px % side != 0 && column < level.columns; ++column)
      mark_block(level, column, level.rows - 1);
  }
}

/// Every block has the edges of its parts.
void EdgeBlocks::pass_up() {
  for (int i = kFinest; i > 0; --i) {
    const Level& parts = at(i);
    Level& whole = at(i - 1);
    for (int row = 0; row < parts.rows; ++row) {
      for (int column = 0; column < parts.columns; ++column) {
        if (has_edge(i, column, row)) mark_block(whole, column / 2, row / 2);
      }
    }
  }
}

void EdgeBlocks::mark(const RayFrame& rays, int width_px, int height_px) {
  clear(width_px, height_px);
  Eigen::Matrix3d ways;
  ways << rays.step_u, rays.step_v, rays.corner;
  const Eigen::Matrix3d to_image = ways.inverse();
  for (std::size_t i = 0; i < corners_m_.size(); ++i) {
    seen_[i] = to_image * (corners_m_[i] - rays.origin_m);
  }
  for (const Edge& edge : edges_) mark_edge(seen_[edge[0]], seen_[edge[1]]);
  pass_up();
}

void EdgeBlocks::mark_edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.z() < kNearest_m && b.z() < kNearest_m) return;
  if (b.z() < a.z()) return mark_edge(b, a);
  // What lies behind the camera is cut off.
  const double share = a.z() < kNearest_m ? (kNearest_m - a.z()) / (b.z() - a.z()) : 0.0;
  const Eigen::Vector3d from = a + share * (b - a);
  mark_segment(from.head<2>() / from.z(), b.head<2>() / b.z());
}

void EdgeBlocks::mark_segment(Eigen::Vector2d a_px, Eigen::Vector2d b_px) {
  if (b_px.y() < a_px.y()) std::swap(a_px, b_px);
  const double last_px = at(kFinest).rows * kFinest_px + kMargin_px;
  const double low_px = std::max(a_px.y(), -1.0), high_px = std::min(b_px.y(), last_px);
  if (low_px > high_px) return;
  const int first = std::max(0, static_cast<int>((low_px - kMargin_px) / kFinest_px));
  const int last =
      std::min(at(kFinest).rows - 1, static_cast<int>((high_px + kMargin_px) / kFinest_px));
  const double rise_px = b_px.y() - a_px.y();
  const double slope = rise_px > 1e-9 ? (b_px.x() - a_px.x()) / rise_px : 0.0;
  for (int row = first; row <= last; ++row) {
    // Where the segment is while it crosses the row of tiles; all of it if it lies level.
    const double top_px = std::max(a_px.y(), row * kFinest_px - kMargin_px - 1.0);
    const double bottom_px = std::min(b_px.y(), (row + 1) * kFinest_px + kMargin_px);
    const bool is_level = rise_px <= 1e-9;
    mark_tiles(is_level ? a_px.x() : a_px.x() + slope * (top_px - a_px.y()),
               is_level ? b_px.x() : a_px.x() + slope * (bottom_px - a_px.y()), row);
  }
}

void EdgeBlocks::mark_tiles(double u_px, double other_u_px, int row) {
  Level& tiles = at(kFinest);
  const double width_px = tiles.columns * kFinest_px;
  const double low_px = std::min(u_px, other_u_px) - kMargin_px - 1.0;
  const double high_px = std::max(u_px, other_u_px) + kMargin_px;
  if (high_px < 0.0 || low_px > width_px) return;
  const int first = static_cast<int>(std::max(low_px, 0.0)) / kFinest_px;
  const int last = static_cast<int>(std::min(high_px, width_px - 1.0)) / kFinest_px;
  const auto begin = tiles.marks.begin() + static_cast<std::ptrdiff_t>(row) * tiles.columns;
  std::fill(begin + first, begin + last + 1, std::uint8_t{1});
}

}  // namespace roomwise::simulator
