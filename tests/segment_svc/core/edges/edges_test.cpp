#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "services/segment_svc/core/edges/edge_labels.h"
#include "services/segment_svc/core/edges/edge_relaxation.h"
#include "tests/segment_svc/support/taught.h"

namespace roomwise::segment {
namespace {

/// Bright square of side 8 in a dark image of 20 x 16, its corner at (6, 4).
std::vector<std::uint8_t> square() {
  std::vector<std::uint8_t> grey(20 * 16, 50);
  for (std::size_t v = 4; v < 12; ++v) {
    for (std::size_t u = 6; u < 14; ++u) grey[v * 20 + u] = 200;
  }
  return grey;
}

float& down_crack(CrackEdges& edges, int u, int v) {
  return edges.down[static_cast<std::size_t>(edges.corner(u, v))];
}

TEST(CrackEdges, AreAsStrongAsLevelsDiffer) {
  CrackEdges edges = find_cracks({10, 40, 250}, 3, 1, 60.0);
  EXPECT_FLOAT_EQ(down_crack(edges, 1, 0), 0.5F);
  EXPECT_FLOAT_EQ(down_crack(edges, 2, 0), 1.0F);
  EXPECT_FLOAT_EQ(down_crack(edges, 0, 0), 0.0F);
  EXPECT_THROW(find_cracks({1, 2, 3}, 2, 2, 60.0), std::invalid_argument);
}

TEST(CrackEdges, StepsLeadToTheNeighboursThatExist) {
  CrackEdges edges = find_cracks(square(), 20, 16, 60.0);
  const auto count = [&](int corner) {
    const auto steps = steps_from(edges, corner);
    return std::count_if(steps.begin(), steps.end(), [](const CrackStep& s) { return s.to >= 0; });
  };
  EXPECT_EQ(count(edges.corner(0, 0)), 2);
  EXPECT_EQ(count(edges.corner(5, 0)), 3);
  EXPECT_EQ(count(edges.corner(20, 16)), 2);
  EXPECT_EQ(count(edges.corner(5, 5)), 4);
}

TEST(EdgeRelaxation, VertexTypeCountsStrongEdges) {
  EXPECT_EQ(vertex_type(0.0F, 0.0F, 0.0F), 0);
  EXPECT_EQ(vertex_type(0.05F, 0.0F, 0.0F), 0);
  EXPECT_EQ(vertex_type(0.9F, 0.1F, 0.0F), 1);
  EXPECT_EQ(vertex_type(0.9F, 0.8F, 0.0F), 2);
  EXPECT_EQ(vertex_type(0.9F, 0.8F, 0.8F), 3);
}

TEST(EdgeRelaxation, ContextSaysWhatThePaperSays) {
  const auto both_ways = [](int a, int b) {
    EXPECT_EQ(crack_evidence(a, b), crack_evidence(b, a));
    return crack_evidence(a, b);
  };
  EXPECT_EQ(both_ways(0, 0), -1);
  EXPECT_EQ(both_ways(0, 1), 0);
  EXPECT_EQ(both_ways(0, 2), -1);
  EXPECT_EQ(both_ways(0, 3), -1);
  EXPECT_EQ(both_ways(1, 1), 1);
  EXPECT_EQ(both_ways(1, 2), 1);
  EXPECT_EQ(both_ways(1, 3), 1);
  EXPECT_EQ(both_ways(2, 2), 0);
  EXPECT_EQ(both_ways(2, 3), 0);
  EXPECT_EQ(both_ways(3, 3), 0);
}

TEST(EdgeRelaxation, ClosesAWeakPlaceInALineAndFadesWhatStandsAlone) {
  CrackEdges edges = find_cracks(square(), 20, 16, 300.0);  // strength 0.5 along the square
  down_crack(edges, 6, 8) = 0.15F;
  down_crack(edges, 17, 8) = 0.5F;
  relax_edges(edges, 10, 0.1F);
  EXPECT_GT(down_crack(edges, 6, 8), 0.9F);
  EXPECT_LT(down_crack(edges, 17, 8), 0.1F);
}

RC_GTEST_PROP(EdgeRelaxation, StrengthsStayBetweenZeroAndOne, ()) {
  const auto grey =
      *rc::gen::container<std::vector<std::uint8_t>>(6 * 5, rc::gen::arbitrary<std::uint8_t>());
  CrackEdges edges = find_cracks(grey, 6, 5, 100.0);
  relax_edges(edges, *rc::gen::inRange(0, 12), 0.3F);
  for (const auto* strengths : {&edges.right, &edges.down}) {
    for (const float s : *strengths) RC_ASSERT(s >= 0.0F && s <= 1.0F);
  }
}

TEST(Borders, TracingGoesAllTheWayRoundASquare) {
  const CrackEdges edges = find_cracks(square(), 20, 16, 60.0);
  const auto borders = trace_borders(edges, 0.5F, 8);
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_EQ(borders[0].size(), 33U);  // 4 x 8 cracks
  EXPECT_EQ(borders[0].front(), borders[0].back());
}

TEST(Borders, ShortOnesAreLeftOut) {
  CrackEdges edges = find_cracks(square(), 20, 16, 60.0);
  down_crack(edges, 17, 3) = 1.0F;
  EXPECT_EQ(trace_borders(edges, 0.5F, 8).size(), 1U);
  EXPECT_EQ(trace_borders(edges, 0.5F, 1).size(), 2U);
}

RC_GTEST_PROP(Borders, EveryEdgeIsTracedOnce, ()) {
  const auto grey =
      *rc::gen::container<std::vector<std::uint8_t>>(6 * 5, rc::gen::arbitrary<std::uint8_t>());
  const CrackEdges edges = find_cracks(grey, 6, 5, 100.0);
  std::multiset<std::pair<int, int>> traced;
  for (const Border& border : trace_borders(edges, 0.5F, 1)) {
    for (std::size_t i = 1; i < border.size(); ++i) {
      traced.insert(std::minmax(border[i - 1], border[i]));
    }
  }
  std::size_t strong = 0;
  for (const auto* strengths : {&edges.right, &edges.down}) {
    strong += static_cast<std::size_t>(
        std::count_if(strengths->begin(), strengths->end(), [](float s) { return s >= 0.5F; }));
  }
  RC_ASSERT(traced.size() == strong);
  RC_ASSERT(std::set(traced.begin(), traced.end()).size() == strong);
}

TEST(Borders, CheapestWayFollowsStrongCracksRoundAboutRatherThanWeakOnesStraight) {
  CrackEdges edges = find_cracks(std::vector<std::uint8_t>(20 * 16, 50), 20, 16, 60.0);
  for (int u = 4; u < 8; ++u) edges.right[static_cast<std::size_t>(edges.corner(u, 6))] = 1.0F;
  down_crack(edges, 4, 5) = down_crack(edges, 8, 5) = 1.0F;
  std::vector<char> is_goal(edges.right.size(), 0);
  is_goal[static_cast<std::size_t>(edges.corner(8, 5))] = 1;
  const Border way = cheapest_way(edges, edges.corner(4, 5), is_goal, 10.0F);
  EXPECT_EQ(way.size(), 7U);  // down, four along, up
  EXPECT_TRUE(cheapest_way(edges, edges.corner(4, 5), is_goal, 0.1F).empty());
}

TEST(Borders, GapInASquareIsClosedSoThatTwoRegionsRemain) {
  CrackEdges edges = find_cracks(square(), 20, 16, 60.0);
  for (int v = 6; v < 9; ++v) down_crack(edges, 6, v) = 0.0F;
  auto borders = trace_borders(edges, 0.5F, 8);
  ASSERT_EQ(borders.size(), 1U);
  const auto count = [&] {
    const auto regions = regions_between(edges, borders);
    return 1 + *std::max_element(regions.begin(), regions.end());
  };
  EXPECT_EQ(count(), 1);
  close_gaps(edges, 8.0F, borders);
  EXPECT_EQ(count(), 2);
}

/// Three stripes of the taught colours, with noise.
ColorImage noisy_stripes() {
  ColorImage color{.width_px = 320, .height_px = 240, .rgb = {}};
  constexpr std::array<std::array<int, 3>, 3> kColors = {
      {{60, 60, 160}, {200, 200, 190}, {150, 110, 70}}};
  for (int i = 0; i < 320 * 240; ++i) {
    const int stripe = std::min(i % 320 / 107, 2);
    for (const int level : kColors[static_cast<std::size_t>(stripe)]) {
      color.rgb.push_back(static_cast<std::uint8_t>(level + i * 7919 % 13 - 6));
    }
  }
  return color;
}

TEST(EdgeLabels, RegionsGetTheClassOfTheirColor) {
  const ColorTable table({around(60, 60, 160), around(200, 200, 190), around(150, 110, 70)});
  const auto labels = label_by_edges(noisy_stripes(), table, 320, 240);
  ASSERT_EQ(labels.size(), 320U * 240U);
  int right = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    right += labels[i] == kTrainedClasses[std::min<std::size_t>(i % 320 / 107, 2)] ? 1 : 0;
  }
  EXPECT_GT(right, 320 * 240 * 98 / 100);
}

TEST(EdgeLabels, AnySizesWillDo) {
  const ColorTable table({around(60, 60, 160), around(200, 200, 190), around(150, 110, 70)});
  const ColorImage one{.width_px = 1, .height_px = 1, .rgb = {60, 60, 160}};
  EXPECT_EQ(label_by_edges(one, table, 17, 16), std::vector<std::uint8_t>(17 * 16, kObstacle));
}

}  // namespace
}  // namespace roomwise::segment
