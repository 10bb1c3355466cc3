#include "services/landmark_svc/core/edge_chains.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace roomwise::landmark {
namespace {

EdgePixel pixel(int u, int v, int depth_mm = 2000, EdgeSide side = EdgeSide::kLeft) {
  return {.u_px = static_cast<std::int16_t>(u),
          .v_px = static_cast<std::int16_t>(v),
          .near_steps = static_cast<std::uint16_t>(depth_mm),
          .side = side};
}

const int kRowStepMost_px = ChainParams{}.row_gap_max_px + 1;

std::vector<std::vector<EdgePixel>> chains_of(const std::vector<EdgePixel>& edges) {
  DisparityTable table;
  table.prepare(0.001, 351.0);
  ChainLinker linker;
  linker.link(edges, table, 640, 480, {});
  std::vector<std::vector<EdgePixel>> chains;
  for (const EdgeChain& chain : linker.chains()) {
    linker.collect(chain, edges, chains.emplace_back());
    EXPECT_EQ(static_cast<int>(chains.back().size()), chain.rows);
  }
  return chains;
}

RC_GTEST_PROP(EdgeChains, EveryEdgeIsInOneChainOfItsSideRowsRisingSteadily, ()) {
  std::vector<EdgePixel> edges;
  std::set<std::pair<int, int>> places;
  for (int i = *rc::gen::inRange(0, 200); i > 0; --i) {
    places.insert({*rc::gen::inRange(0, 30), *rc::gen::inRange(0, 40)});
  }
  for (const auto& [v, u] : places) {
    edges.push_back(pixel(u, v, *rc::gen::element(1500, 1530, 2500),
                          *rc::gen::element(EdgeSide::kLeft, EdgeSide::kRight)));
  }
  std::size_t total = 0;
  for (const auto& chain : chains_of(edges)) {
    total += chain.size();
    for (std::size_t i = 1; i < chain.size(); ++i) {
      RC_ASSERT(chain[i].side == chain[0].side);
      RC_ASSERT(chain[i].v_px < chain[i - 1].v_px);
      RC_ASSERT(chain[i].v_px >= chain[i - 1].v_px - kRowStepMost_px);
      RC_ASSERT(std::abs(chain[i].u_px - chain[i - 1].u_px) <= 4);
      RC_ASSERT(std::abs(chain[i].near_steps - chain[i - 1].near_steps) <= 115);
    }
  }
  RC_ASSERT(total == edges.size());
}

TEST(EdgeChains, FollowOneEdgeAcrossMissingRows) {
  std::vector<EdgePixel> edges;
  for (int v = 0; v < 60; ++v) {
    if (v % 10 < 7) edges.push_back(pixel(100 + v / 20, v));
  }
  EXPECT_EQ(chains_of(edges).size(), 1u);
}

TEST(EdgeChains, PartAtADepthJumpAWideStepOrALongPause) {
  EXPECT_EQ(chains_of({pixel(100, 0, 2000), pixel(100, 1, 2200)}).size(), 2u);
  EXPECT_EQ(chains_of({pixel(100, 0), pixel(105, 1)}).size(), 2u);
  EXPECT_EQ(chains_of({pixel(100, 0), pixel(100, kRowStepMost_px)}).size(), 1u);
  EXPECT_EQ(chains_of({pixel(100, 0), pixel(100, kRowStepMost_px + 1)}).size(), 2u);
  EXPECT_EQ(chains_of({pixel(100, 0), pixel(100, 1, 2000, EdgeSide::kRight)}).size(), 2u);
}

std::size_t open_edges(std::vector<EdgePixel> edges) {
  DisparityTable table;
  table.prepare(0.001, 351.0);
  ChainLinker linker;
  linker.link(edges, table, 640, 480, {});
  linker.prove_open_edges(edges, table, 640, 480, {});
  return static_cast<std::size_t>(std::count_if(
      edges.begin(), edges.end(), [](const EdgePixel& edge) { return edge.is_open; }));
}

/// A door post: rows before what is too far, then `measured` rows before the floor.
std::vector<EdgePixel> post(int measured, int measured_u, int measured_mm, EdgeSide side) {
  std::vector<EdgePixel> edges;
  for (int v = 0; v < 100; ++v) {
    edges.push_back(pixel(300, v));
    edges.back().is_open = true;
  }
  for (int v = 120; v < 120 + measured; ++v)
    edges.push_back(pixel(measured_u, v, measured_mm, side));
  return edges;
}

TEST(EdgeChains, OpenEdgesNeedMeasuredOnesAtTheirFoot) {
  EXPECT_EQ(open_edges(post(10, 301, 2020, EdgeSide::kLeft)), 0u);
  EXPECT_EQ(open_edges(post(0, 301, 2020, EdgeSide::kLeft)), 100u);
  EXPECT_EQ(open_edges(post(3, 301, 2020, EdgeSide::kLeft)), 100u);    // too few
  EXPECT_EQ(open_edges(post(10, 320, 2020, EdgeSide::kLeft)), 100u);   // elsewhere
  EXPECT_EQ(open_edges(post(10, 301, 2500, EdgeSide::kLeft)), 100u);   // another thing
  EXPECT_EQ(open_edges(post(10, 301, 2020, EdgeSide::kRight)), 100u);  // its other side
}

}  // namespace
}  // namespace roomwise::landmark
