#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace roomwise::segment {

/// Edges along the cracks between pixels: a graph whose vertices are the pixels' corners,
/// (width + 1) x (height + 1) of them, row by row. Each crack joins two neighbouring corners.
struct CrackEdges {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> right;  ///< strength of the crack from a corner to the one on its right, 0..1:
                             ///< between the pixel above it and the one below
  std::vector<float> down;   ///< from a corner to the one below it: between left and right pixel

  int corners_across() const { return width_px + 1; }
  int corner(int u, int v) const { return v * corners_across() + u; }
};

/// A crack as seen from one of its corners.
struct CrackStep {
  int to = -1;  ///< the other corner; negative: the image ends here
  float* strength = nullptr;
};

/// Steps from a corner: right, down, left, up.
std::array<CrackStep, 4> steps_from(CrackEdges& edges, int corner);

/// Cracks of a grey image (height x width, row by row), each as strong as its grey levels differ:
/// 1 from `full_levels` on. Throws std::invalid_argument if the sizes differ.
CrackEdges find_cracks(const std::vector<std::uint8_t>& grey, int width_px, int height_px,
                       double full_levels);

}  // namespace roomwise::segment
