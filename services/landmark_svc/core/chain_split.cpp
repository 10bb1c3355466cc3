#include "services/landmark_svc/core/chain_split.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

struct Bend {
  std::size_t pixel;
  double deviation_px;
};

/// The pixel of [piece.begin, piece.end) farthest in column from the line between its ends.
Bend sharpest_bend(std::span<const EdgePixel> chain, const ChainPiece& piece) {
  const EdgePixel& first = chain[piece.begin];
  const EdgePixel& last = chain[piece.end - 1];
  const int rows = last.v_px - first.v_px;
  const double slope = rows == 0 ? 0.0 : static_cast<double>(last.u_px - first.u_px) / rows;
  Bend sharpest{piece.begin, 0.0};
  for (std::size_t i = piece.begin; i < piece.end; ++i) {
    const double line_px = first.u_px + slope * (chain[i].v_px - first.v_px);
    const double deviation_px = std::abs(chain[i].u_px - line_px);
    if (deviation_px > sharpest.deviation_px) sharpest = {i, deviation_px};
  }
  return sharpest;
}

}  // namespace

void split_at_bends(std::span<const EdgePixel> chain, double bend_max_px, std::size_t rows_min,
                    std::vector<ChainPiece>& pieces) {
  pieces.clear();
  if (chain.empty()) return;
  const std::size_t not_cut = std::max<std::size_t>(rows_min, 2);
  ChainPiece piece{0, chain.size()};
  while (true) {
    const bool is_long = piece.end - piece.begin >= not_cut;
    const Bend bend = is_long ? sharpest_bend(chain, piece) : Bend{piece.begin, 0.0};
    if (bend.deviation_px > bend_max_px) {
      piece.end = bend.pixel;  // not the first pixel: the line passes through that
      continue;
    }
    pieces.push_back(piece);
    if (piece.end == chain.size()) return;
    piece = {piece.end, chain.size()};
  }
}

}  // namespace roomwise::landmark
