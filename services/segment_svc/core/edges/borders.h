#pragma once
#include <vector>

#include "services/segment_svc/core/edges/crack_edges.h"

namespace roomwise::segment {

/// Corners along a border, in order. It is closed if it ends where it began.
using Border = std::vector<int>;

/// Traces borders greedily: from each edge not yet traced on, both ways, always along the strongest
/// edge not yet traced, until there is none of at least `strength_min`. Borders of fewer than
/// `cracks_min` cracks are left out.
std::vector<Border> trace_borders(CrackEdges edges, float strength_min, std::size_t cracks_min);

/// The cheapest way from a corner to one where `is_goal` says so (Dijkstra 1959); a crack costs
/// 1.05 - strength. Empty if all cost more than `cost_max`. `is_goal` has an entry for each corner.
Border cheapest_way(CrackEdges& edges, int from, const std::vector<char>& is_goal, float cost_max);

/// Continues each open border from its ends to another border or the image's side, where there is a
/// way that costs at most `cost_max`; the ways are added to `borders`.
void close_gaps(CrackEdges& edges, float cost_max, std::vector<Border>& borders);

}  // namespace roomwise::segment
