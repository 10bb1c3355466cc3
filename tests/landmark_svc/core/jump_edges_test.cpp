#include "services/landmark_svc/core/jump_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/landmark_svc/support/kinect_effects.h"

namespace roomwise::landmark {
namespace {

using Row = std::vector<std::uint16_t>;

struct Found {
  std::vector<EdgePixel> edges;
  RejectCounts rejected;
};

Found find(const DepthImage& depth, const JumpEdgeParams& params = {},
           const RegionParams& region = {}) {
  DisparityTable table;
  table.prepare(depth.unit_m, 351.0);
  JumpEdgeFinder finder;
  Found found;
  finder.find(depth, table, region_of_interest(region, depth.width_px, depth.height_px), params,
              found.edges, found.rejected);
  return found;
}

DepthImage image_of(const Row& row) {
  return {.width_px = static_cast<int>(row.size()), .height_px = 1, .unit_m = 0.001, .steps = row};
}

/// Runs of pixels: {count, depth in millimetres}.
Row runs(std::initializer_list<std::pair<int, int>> parts) {
  Row row;
  for (const auto& [count, depth_mm] : parts) {
    row.insert(row.end(), static_cast<std::size_t>(count), static_cast<std::uint16_t>(depth_mm));
  }
  return row;
}

/// A row of random runs, bad ones among them: everything an edge finder may meet.
Row random_row(int width) {
  Row row;
  while (static_cast<int>(row.size()) < width) {
    const int length = *rc::gen::inRange(1, 12);
    const int depth_mm = *rc::gen::element(0, 0, 65535, 5000, 700, 1100, 1180, 1500, 2500, 3900);
    for (int i = 0; i < length; ++i) {
      const int noise_mm = depth_mm == 65535 ? 0 : *rc::gen::inRange(0, 30);
      row.push_back(static_cast<std::uint16_t>(depth_mm == 0 ? 0 : depth_mm + noise_mm));
    }
  }
  row.resize(static_cast<std::size_t>(width));
  return row;
}

EdgePixel seen_in_a_mirror(EdgePixel edge, int width) {
  edge.u_px = static_cast<std::int16_t>(width - 1 - edge.u_px);
  edge.side = edge.side == EdgeSide::kLeft ? EdgeSide::kRight : EdgeSide::kLeft;
  return edge;
}

RC_GTEST_PROP(JumpEdges, MirrorSwapsSides, ()) {
  const Row row = random_row(*rc::gen::inRange(1, 90));
  const Row reversed(row.rbegin(), row.rend());
  JumpEdgeParams params;
  params.gap_max_px = 240.0;
  const auto edges = find(image_of(row), params).edges;
  auto mirrored_back = find(image_of(reversed), params).edges;
  std::reverse(mirrored_back.begin(), mirrored_back.end());
  for (EdgePixel& edge : mirrored_back) {
    edge = seen_in_a_mirror(edge, static_cast<int>(row.size()));
  }
  RC_ASSERT(edges == mirrored_back);
}

RC_GTEST_PROP(JumpEdges, EveryEdgeIsWhatTheParametersSay, ()) {
  const Row row = random_row(80);
  const DepthImage depth = image_of(row);
  JumpEdgeParams params;
  params.gap_max_px = 100.0;
  for (const EdgePixel& edge : find(depth, params).edges) {
    const int far_u = edge.u_px - edge.inward_px() * edge.gap_px;
    RC_ASSERT(depth.at(edge.u_px, 0) == edge.near_steps);
    RC_ASSERT(depth.at(far_u, 0) == edge.far_steps);
    RC_ASSERT(edge.far_steps - edge.near_steps >= 60);
    RC_ASSERT(351.0 / (edge.near_steps * 0.001) - 351.0 / (edge.far_steps * 0.001) > 4.0 - 0.126);
    RC_ASSERT(edge.near_steps >= 600 && edge.near_steps <= 3810);
    RC_ASSERT(edge.gap_px - 1 <= 13);  // 100 px at 640 columns are 12.5 at 80
    for (int k = 1; k < edge.gap_px; ++k) {
      const int between = depth.at(edge.u_px - edge.inward_px() * k, 0);
      RC_ASSERT(between == 0 || between > 4095);
    }
  }
}

RC_GTEST_PROP(JumpEdges, NarrowerRangeOnlyFilters, ()) {
  const DepthImage depth = image_of(random_row(80));
  JumpEdgeParams narrow;
  narrow.range_min_m = *rc::gen::inRange(600, 1500) * 0.001;
  narrow.range_max_m = *rc::gen::inRange(1501, 3810) * 0.001;
  auto expected = find(depth).edges;
  std::erase_if(expected, [&](const EdgePixel& edge) {
    return edge.near_steps * 0.001 < narrow.range_min_m - 1e-9 ||
           edge.near_steps * 0.001 > narrow.range_max_m + 1e-9;
  });
  RC_ASSERT(find(depth, narrow).edges == expected);
}

/// A plane at any slant, even one that rushes past the camera.
DepthImage random_plane() {
  const double quanta = *rc::gen::inRange(90, 600);
  const double du = *rc::gen::inRange(-8000, 8000) * 0.001;
  const double dv = *rc::gen::inRange(-1000, 1000) * 0.001;
  return plane_image(120, 12, quanta, du, dv, 0.3, *rc::gen::arbitrary<std::uint32_t>());
}

RC_GTEST_PROP(JumpEdges, PlaneHasNone, ()) { RC_ASSERT(find(random_plane()).edges.empty()); }

RC_GTEST_PROP(JumpEdges, BadPixelsInventNoneOnAPlane, ()) {
  DepthImage depth = random_plane();
  const double share = *rc::gen::inRange(0, 70) * 0.01;
  add_dropouts(depth, share, *rc::gen::arbitrary<std::uint32_t>());
  JumpEdgeParams params;
  params.gap_max_px = 24.0 * 640.0 / 120.0;
  RC_ASSERT(find(depth, params).edges.empty());
}

TEST(JumpEdges, BoxBeforeAWallHasTwo) {
  const auto found = find(image_of(runs({{20, 3000}, {20, 1500}, {20, 3000}})));
  ASSERT_EQ(found.edges.size(), 2u);
  EXPECT_EQ(found.edges[0], (EdgePixel{.u_px = 20,
                                       .v_px = 0,
                                       .near_steps = 1500,
                                       .far_steps = 3000,
                                       .gap_px = 1,
                                       .near_run_px = kNearRunMax_px,
                                       .side = EdgeSide::kLeft}));
  EXPECT_EQ(found.edges[1].u_px, 39);
  EXPECT_EQ(found.edges[1].side, EdgeSide::kRight);
}

TEST(JumpEdges, BridgesBadDataUpToTheGap) {
  JumpEdgeParams params;
  const auto edges_over = [&](int bad, int width) {
    return find(image_of(runs({{20, 1000}, {bad, 0}, {width - 20 - bad, 3000}})), params)
        .edges.size();
  };
  EXPECT_EQ(edges_over(24, 640), 1u);
  EXPECT_EQ(edges_over(25, 640), 0u);
  EXPECT_EQ(edges_over(48, 1280), 1u);
  EXPECT_EQ(edges_over(49, 1280), 0u);
}

TEST(JumpEdges, SmallStepIsNone) {
  EXPECT_TRUE(find(image_of(runs({{20, 1000}, {20, 1059}}))).edges.empty());
  EXPECT_EQ(find(image_of(runs({{20, 1000}, {20, 1060}}))).edges.size(), 1u);
  // At 3 m, 6 cm is two quanta: the sensor's own noise.
  EXPECT_TRUE(find(image_of(runs({{20, 3000}, {20, 3080}}))).edges.empty());
  EXPECT_EQ(find(image_of(runs({{20, 3000}, {20, 3120}}))).edges.size(), 1u);
}

TEST(JumpEdges, FlyingPixelsAndSpecksAreNone) {
  const auto flying = find(image_of(runs({{20, 1500}, {2, 2000}, {20, 3000}})));
  ASSERT_EQ(flying.edges.size(), 1u);
  EXPECT_EQ(flying.edges[0].u_px, 19);
  EXPECT_EQ(flying.rejected.of(RejectReason::kEdgeNearTooShort), 1);

  const auto speck = find(image_of(runs({{20, 3000}, {3, 1500}, {20, 3000}})));
  EXPECT_TRUE(speck.edges.empty());
  EXPECT_EQ(speck.rejected.of(RejectReason::kEdgeNearTooShort), 2);

  const auto hole = find(image_of(runs({{20, 1500}, {1, 3000}, {20, 1500}})));
  EXPECT_TRUE(hole.edges.empty());
  EXPECT_EQ(hole.rejected.of(RejectReason::kEdgeFarTooShort), 2);
}

TEST(JumpEdges, BadDataAloneIsNoEdge) {
  EXPECT_TRUE(find(image_of(runs({{20, 1500}, {20, 0}}))).edges.empty());
  EXPECT_TRUE(find(image_of(runs({{20, 1500}, {20, 65535}}))).edges.empty());
  EXPECT_TRUE(find(image_of(runs({{20, 1500}, {20, 4096}}))).edges.empty());
}

JumpEdgeParams with_open_edges() {
  JumpEdgeParams params;
  params.finds_open = true;
  return params;
}

TEST(JumpEdges, BeforeReadingsBeyondStandOpenEdges) {
  const auto found = find(image_of(runs({{20, 1500}, {20, 6000}, {20, 1700}})), with_open_edges());
  ASSERT_EQ(found.edges.size(), 2u);
  EXPECT_EQ(found.edges[0].u_px, 19);
  EXPECT_EQ(found.edges[0].side, EdgeSide::kRight);
  EXPECT_EQ(found.edges[1].u_px, 40);
  EXPECT_EQ(found.edges[1].side, EdgeSide::kLeft);
  for (const EdgePixel& edge : found.edges) EXPECT_TRUE(edge.is_open);
}

TEST(JumpEdges, AShadowBeforeReadingsBeyondIsBridged) {
  Row row = runs({{20, 1500}, {2, 0}, {20, 6000}});
  row.resize(640, 0);
  const auto found = find(image_of(row), with_open_edges());
  ASSERT_EQ(found.edges.size(), 1u);
  EXPECT_EQ(found.edges[0].u_px, 19);
  EXPECT_EQ(found.edges[0].gap_px, 3);
}

TEST(JumpEdges, HolesAndAMeasuredFarSideMakeNoOpenEdge) {
  EXPECT_TRUE(find(image_of(runs({{20, 1500}, {20, 0}})), with_open_edges()).edges.empty());
  EXPECT_TRUE(find(image_of(runs({{20, 1500}, {20, 65535}})), with_open_edges()).edges.empty());
  const auto found = find(image_of(runs({{20, 1500}, {1, 6000}, {20, 2500}})), with_open_edges());
  for (const EdgePixel& edge : found.edges) EXPECT_FALSE(edge.is_open);
}

RC_GTEST_PROP(JumpEdges, OpenEdgesAreAddedAndTakeNoneAway, ()) {
  const Row row = random_row(200);
  auto found = find(image_of(row), with_open_edges()).edges;
  for (std::size_t i = 1; i < found.size(); ++i) RC_ASSERT(found[i - 1].u_px <= found[i].u_px);
  std::erase_if(found, [](const EdgePixel& edge) { return edge.is_open; });
  RC_ASSERT(found == find(image_of(row)).edges);
}

TEST(JumpEdges, OnlyTheRegionIsSeen) {
  const auto row = runs({{20, 3000}, {20, 1500}, {20, 3000}});
  RegionParams right;
  right.region = "top_right";
  DepthImage depth = image_of(row);
  depth.height_px = 2;
  depth.steps.insert(depth.steps.end(), row.begin(), row.end());
  const auto found = find(depth, {}, right);
  ASSERT_EQ(found.edges.size(), 1u);
  EXPECT_EQ(found.edges[0].u_px, 39);
}

}  // namespace
}  // namespace roomwise::landmark
