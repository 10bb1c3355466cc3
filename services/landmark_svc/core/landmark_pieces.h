#pragma once
#include <cstddef>
#include <vector>

#include "services/landmark_svc/core/landmark.h"
#include "services/landmark_svc/core/reject_counts.h"

namespace roomwise::landmark {

/// Joins landmarks that are pieces of one physical edge: same kind and positions that differ by
/// less than chance (squared Mahalanobis distance < `gate_mahalanobis_sq`). Pieces one above the
/// other are averaged by rows; of two side by side the better scored stays. Two map points closer
/// than their own error would only be mistaken for each other. O(landmarks^2).
void join_pieces(std::vector<Landmark>& landmarks, double gate_mahalanobis_sq,
                 RejectCounts& rejected);

/// Drops creases within 6 cm of an edge or a pole: a box whose side is seen at a grazing angle
/// shows its corner both ways, and the edge is seen from farther round.
void drop_creases_at_edges(std::vector<Landmark>& landmarks, RejectCounts& rejected);

/// Keeps the `most` best scored landmarks, then orders them from left to right.
void keep_best(std::vector<Landmark>& landmarks, std::size_t most, RejectCounts& rejected);

}  // namespace roomwise::landmark
