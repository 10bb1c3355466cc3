#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "services/landmark_svc/core/edge_pixel.h"

namespace roomwise::landmark {

/// Pixels [begin, end) of a chain.
struct ChainPiece {
  std::size_t begin;
  std::size_t end;
};

/// Cuts a chain where it bends, so that a table's slanted rim does not spoil the leg below it:
/// a piece is cut at the pixel farthest in column from the straight line between its ends, as long
/// as that is more than `bend_max_px`. Pieces of fewer than `rows_min` pixels are not cut further.
/// Every pixel ends up in exactly one of `pieces`, in order. A few passes over the chain; for the
/// worst of chains one per pixel.
///
/// Source: Ramer, "An iterative procedure for the polygonal approximation of plane curves" (1972).
void split_at_bends(std::span<const EdgePixel> chain, double bend_max_px, std::size_t rows_min,
                    std::vector<ChainPiece>& pieces);

}  // namespace roomwise::landmark
