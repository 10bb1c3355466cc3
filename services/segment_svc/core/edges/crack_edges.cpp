#include "services/segment_svc/core/edges/crack_edges.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace roomwise::segment {

std::array<CrackStep, 4> steps_from(CrackEdges& edges, int corner) {
  const int across = edges.corners_across();
  const int u = corner % across;
  const int v = corner / across;
  std::array<CrackStep, 4> steps;
  const auto step = [](std::vector<float>& strengths, int from, int to) {
    return CrackStep{.to = to, .strength = &strengths[static_cast<std::size_t>(from)]};
  };
  if (u < edges.width_px) steps[0] = step(edges.right, corner, corner + 1);
  if (v < edges.height_px) steps[1] = step(edges.down, corner, corner + across);
  if (u > 0) steps[2] = step(edges.right, corner - 1, corner - 1);
  if (v > 0) steps[3] = step(edges.down, corner - across, corner - across);
  return steps;
}

CrackEdges find_cracks(const std::vector<std::uint8_t>& grey, int width_px, int height_px,
                       double full_levels) {
  if (grey.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("cracks: the image is not width x height");
  }
  CrackEdges edges{.width_px = width_px, .height_px = height_px, .right = {}, .down = {}};
  const auto corners = static_cast<std::size_t>(edges.corner(0, height_px + 1));
  edges.right.assign(corners, 0.0F);
  edges.down.assign(corners, 0.0F);
  const auto at = [&](int u, int v) { return grey[static_cast<std::size_t>(v * width_px + u)]; };
  const auto strength = [&](int a, int b) {
    return static_cast<float>(std::min(1.0, std::abs(a - b) / full_levels));
  };
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const auto corner = static_cast<std::size_t>(edges.corner(u, v));
      if (v > 0) edges.right[corner] = strength(at(u, v - 1), at(u, v));
      if (u > 0) edges.down[corner] = strength(at(u - 1, v), at(u, v));
    }
  }
  return edges;
}

}  // namespace roomwise::segment
