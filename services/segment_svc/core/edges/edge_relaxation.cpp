#include "services/segment_svc/core/edges/edge_relaxation.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace roomwise::segment {
namespace {

constexpr float kFaint = 0.1F;  // strengths below it all count as none

/// Type of the end `corner` of the crack that leads from there to `other`.
int type_at(CrackEdges& edges, int corner, int other) {
  std::array<float, 3> strengths{};
  std::size_t count = 0;
  for (const CrackStep& step : steps_from(edges, corner)) {
    if (step.to >= 0 && step.to != other && count < strengths.size()) {
      strengths[count++] = *step.strength;
    }
  }
  std::sort(strengths.begin(), strengths.end(), std::greater<>());
  return vertex_type(strengths[0], strengths[1], strengths[2]);
}

float relaxed(CrackEdges& edges, int from, int to, float strength, float step) {
  if (from < 0 || to < 0) return strength;
  const int evidence = crack_evidence(type_at(edges, from, to), type_at(edges, to, from));
  return std::clamp(strength + static_cast<float>(evidence) * step, 0.0F, 1.0F);
}

}  // namespace

int vertex_type(float a, float b, float c) {
  const float m = std::max(a, kFaint);
  const std::array<float, 4> products = {(m - a) * (m - b) * (m - c), a * (m - b) * (m - c),
                                         a * b * (m - c), a * b * c};
  const auto best = std::max_element(products.begin(), products.end());
  return static_cast<int>(best - products.begin());
}

int crack_evidence(int type_of_one_end, int type_of_other_end) {
  const auto [fewer, more] = std::minmax(type_of_one_end, type_of_other_end);
  if (fewer == 0) return more == 1 ? 0 : -1;
  return fewer == 1 ? 1 : 0;
}

void relax_edges(CrackEdges& edges, int rounds, float step) {
  const int across = edges.corners_across();
  for (int round = 0; round < rounds; ++round) {
    std::vector<float> right = edges.right;
    std::vector<float> down = edges.down;
    for (int v = 0; v <= edges.height_px; ++v) {
      for (int u = 0; u <= edges.width_px; ++u) {
        const int corner = edges.corner(u, v);
        const auto i = static_cast<std::size_t>(corner);
        if (u < edges.width_px) right[i] = relaxed(edges, corner, corner + 1, right[i], step);
        if (v < edges.height_px) down[i] = relaxed(edges, corner, corner + across, down[i], step);
      }
    }
    edges.right = std::move(right);
    edges.down = std::move(down);
  }
}

}  // namespace roomwise::segment
