#include "services/segment_svc/core/edges/borders.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace roomwise::segment {
namespace {

constexpr float kDearest = 1.05F;  // a little above 1: of two ways as strong, the shorter

/// The strongest crack at a corner; without `to` if none is strong enough.
CrackStep strongest(CrackEdges& edges, int corner, float strength_min) {
  CrackStep best;
  for (const CrackStep& step : steps_from(edges, corner)) {
    if (step.to < 0 || *step.strength < strength_min) continue;
    if (best.to < 0 || *step.strength > *best.strength) best = step;
  }
  return best;
}

/// Follows untraced edges from a corner, and takes them out of `edges`.
void follow(CrackEdges& edges, int corner, float strength_min, Border& border) {
  for (CrackStep step = strongest(edges, corner, strength_min); step.to >= 0;
       step = strongest(edges, step.to, strength_min)) {
    *step.strength = -1.0F;
    border.push_back(step.to);
  }
}

Border way_back(const std::vector<int>& came_from, int from, int to) {
  Border way(1, to);
  while (way.back() != from) way.push_back(came_from[static_cast<std::size_t>(way.back())]);
  std::reverse(way.begin(), way.end());
  return way;
}

bool is_on_side(const CrackEdges& edges, int corner) {
  const int u = corner % edges.corners_across();
  const int v = corner / edges.corners_across();
  return u == 0 || v == 0 || u == edges.width_px || v == edges.height_px;
}

}  // namespace

std::vector<Border> trace_borders(CrackEdges edges, float strength_min, std::size_t cracks_min) {
  std::vector<Border> borders;
  for (int corner = 0; corner < static_cast<int>(edges.right.size()); ++corner) {
    while (strongest(edges, corner, strength_min).to >= 0) {
      Border border(1, corner);
      follow(edges, corner, strength_min, border);
      std::reverse(border.begin(), border.end());
      follow(edges, corner, strength_min, border);
      if (border.size() > cracks_min) borders.push_back(std::move(border));
    }
  }
  return borders;
}

Border cheapest_way(CrackEdges& edges, int from, const std::vector<char>& is_goal, float cost_max) {
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<float> cost(is_goal.size(), std::numeric_limits<float>::infinity());
  std::vector<int> came_from(is_goal.size(), -1);
  open.push({0.0F, from});
  cost[static_cast<std::size_t>(from)] = 0.0F;
  while (!open.empty()) {
    const auto [spent, corner] = open.top();
    open.pop();
    if (spent > cost[static_cast<std::size_t>(corner)]) continue;
    if (is_goal[static_cast<std::size_t>(corner)] != 0) return way_back(came_from, from, corner);
    for (const CrackStep& step : steps_from(edges, corner)) {
      if (step.to < 0) continue;
      const float next = spent + kDearest - *step.strength;
      float& known = cost[static_cast<std::size_t>(step.to)];
      if (next > cost_max || next >= known) continue;
      known = next;
      came_from[static_cast<std::size_t>(step.to)] = corner;
      open.push({next, step.to});
    }
  }
  return {};
}

void close_gaps(CrackEdges& edges, float cost_max, std::vector<Border>& borders) {
  std::vector<char> is_goal(edges.right.size(), 0);
  for (int corner = 0; corner < static_cast<int>(is_goal.size()); ++corner) {
    is_goal[static_cast<std::size_t>(corner)] = is_on_side(edges, corner) ? 1 : 0;
  }
  const auto mark = [&](const Border& border, int change) {
    for (const int corner : border) {
      char& goal = is_goal[static_cast<std::size_t>(corner)];
      goal = static_cast<char>(goal + change);
    }
  };
  for (Border& border : borders) mark(border, 2);
  const std::size_t traced = borders.size();
  for (std::size_t i = 0; i < traced; ++i) {
    if (borders[i].front() == borders[i].back()) continue;
    for (const int end : {borders[i].front(), borders[i].back()}) {
      std::vector<char> others = is_goal;
      // What only this border passes is no goal of its own.
      for (const int corner : borders[i]) {
        char& goal = others[static_cast<std::size_t>(corner)];
        goal = goal == 2 ? 0 : goal;
      }
      Border way = cheapest_way(edges, end, others, cost_max);
      if (way.size() > 1) borders.push_back(std::move(way));
    }
  }
}

}  // namespace roomwise::segment
