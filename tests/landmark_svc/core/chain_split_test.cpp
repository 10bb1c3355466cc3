#include "services/landmark_svc/core/chain_split.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace roomwise::landmark {
namespace {

EdgePixel pixel_at(int u, int v) {
  return {.u_px = static_cast<std::int16_t>(u), .v_px = static_cast<std::int16_t>(v)};
}

std::vector<ChainPiece> split(const std::vector<EdgePixel>& chain) {
  std::vector<ChainPiece> pieces;
  split_at_bends(chain, 4.0, 18, pieces);
  return pieces;
}

RC_GTEST_PROP(ChainSplit, KeepsEveryPixelOnceAndLeavesNoLongBentPiece, ()) {
  std::vector<EdgePixel> chain;
  int u = 300;
  for (int v = 400; v > 400 - *rc::gen::inRange(1, 200); --v) {
    u += *rc::gen::inRange(-4, 5);
    chain.push_back(pixel_at(u, v));
  }
  std::size_t next = 0;
  for (const ChainPiece& piece : split(chain)) {
    RC_ASSERT(piece.begin == next && piece.end > piece.begin);
    next = piece.end;
    if (piece.end - piece.begin < 18) continue;
    const EdgePixel& first = chain[piece.begin];
    const EdgePixel& last = chain[piece.end - 1];
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      const double along = double(chain[i].v_px - first.v_px) / (last.v_px - first.v_px);
      RC_ASSERT(std::abs(chain[i].u_px - first.u_px - along * (last.u_px - first.u_px)) <= 4.0);
    }
  }
  RC_ASSERT(next == chain.size());
}

TEST(ChainSplit, CutsARimFromTheLegBelow) {
  std::vector<EdgePixel> chain;
  for (int v = 200; v > 120; --v) chain.push_back(pixel_at(100, v));
  for (int v = 120; v > 60; --v) chain.push_back(pixel_at(100 + 3 * (120 - v), v));
  const auto pieces = split(chain);
  ASSERT_GE(pieces.size(), 2u);
  EXPECT_NEAR(static_cast<double>(pieces[0].end), 80.0, 3.0);
}

TEST(ChainSplit, NothingHasNoPieces) { EXPECT_TRUE(split({}).empty()); }

}  // namespace
}  // namespace roomwise::landmark
