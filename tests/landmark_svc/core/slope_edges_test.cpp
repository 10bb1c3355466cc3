#include "services/landmark_svc/core/slope_edges.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

struct Scene {
  RgbdFrame frame;
  SlopeEdgeParams params{.threshold_mm_per_px = 0.0, .range_min_m = 1.22, .range_max_m = 3.81};
  double alpha_ratio = 0.0;
};

std::vector<EdgePixel> find(const Scene& scene) {
  DisparityTable table;
  table.prepare(scene.frame.depth.unit_m, 351.0);
  ColorAtDepth color;
  color.attach(scene.frame);
  std::vector<EdgePixel> edges;
  RejectCounts rejected;
  const DepthImage& depth = scene.frame.depth;
  SlopeEdgeFinder().find(depth, table, color, {0, 0, depth.width_px, depth.height_px}, scene.params,
                         {}, scene.alpha_ratio, edges, rejected);
  return edges;
}

Scene scene_of(const std::vector<std::uint16_t>& row) {
  Scene scene;
  scene.frame.depth = {
      .width_px = static_cast<int>(row.size()), .height_px = 1, .unit_m = 0.001, .steps = row};
  return scene;
}

void paint(Scene& scene, const std::vector<std::uint8_t>& grey) {
  scene.frame.depth_registered = true;
  scene.frame.color.width_px = static_cast<int>(grey.size());
  scene.frame.color.height_px = 1;
  for (const std::uint8_t level : grey) {
    scene.frame.color.rgb.insert(scene.frame.color.rgb.end(), 3, level);
  }
}

std::vector<std::uint16_t> random_row() {
  return *rc::gen::container<std::vector<std::uint16_t>>(
      60, rc::gen::map(rc::gen::inRange(0, 5000), [](int value) {
        return static_cast<std::uint16_t>(value < 800 ? 0 : value);
      }));
}

/// The published pseudo-code, word for word and slowly.
std::vector<int> columns_by_pseudo_code(const Scene& scene) {
  const auto& row = scene.frame.depth.steps;
  const int width = static_cast<int>(row.size());
  const auto good = [&](int u) {
    return row[static_cast<std::size_t>(u)] >= 60 && row[static_cast<std::size_t>(u)] <= 4095;
  };
  const auto z = [&](int u) { return static_cast<double>(row[static_cast<std::size_t>(u)]); };
  std::vector<int> columns;
  for (int u = 0; u < width; ++u) {
    int left = u - 1;
    int right = u + 1;
    while (left >= 0 && !good(left)) --left;
    while (right < width && !good(right)) ++right;
    if (!good(u) || left < 0 || right >= width) continue;
    if (z(u) >= z(left) && z(u) >= z(right)) continue;
    if (z(u) < 1220.0 || z(u) > 3810.0) continue;
    const double right_slope = (z(right) - z(u)) / (right - u);
    const double left_slope = (z(u) - z(left)) / (u - left);
    if (std::abs(right_slope - left_slope) > scene.params.threshold_mm_per_px) columns.push_back(u);
  }
  return columns;
}

RC_GTEST_PROP(SlopeEdges, IsThePseudoCode, ()) {
  Scene scene = scene_of(random_row());
  scene.params.threshold_mm_per_px = *rc::gen::element(0.0, 100.0, 1000.0);
  std::vector<int> columns;
  for (const EdgePixel& edge : find(scene)) columns.push_back(edge.u_px);
  RC_ASSERT(columns == columns_by_pseudo_code(scene));
}

RC_GTEST_PROP(SlopeEdges, LargerThresholdNeverGivesMore, ()) {
  Scene scene = scene_of(random_row());
  paint(scene,
        *rc::gen::container<std::vector<std::uint8_t>>(60, rc::gen::arbitrary<std::uint8_t>()));
  scene.alpha_ratio = *rc::gen::inRange(0, 101) * 0.01;
  scene.params.threshold_mm_per_px = *rc::gen::inRange(0, 1000);
  const auto many = find(scene);
  scene.params.threshold_mm_per_px += *rc::gen::inRange(0, 1000);
  for (const EdgePixel& edge : find(scene)) {
    RC_ASSERT(std::find(many.begin(), many.end(), edge) != many.end());
  }
}

TEST(SlopeEdges, OnlyTheNearSideAndOnlyInRange) {
  const auto edges = find(scene_of({2000, 2000, 2000, 3000, 3000, 3000}));
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].u_px, 2);
  EXPECT_EQ(edges[0].side, EdgeSide::kRight);
  EXPECT_TRUE(find(scene_of({1200, 1200, 1200, 3000, 3000})).empty());
  EXPECT_TRUE(find(scene_of({3900, 3900, 3900, 4090, 4090})).empty());
}

TEST(SlopeEdges, BadDataIsBridged) {
  const auto edges = find(scene_of({2000, 2000, 0, 65535, 4096, 3000, 3000}));
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].u_px, 1);
  EXPECT_EQ(edges[0].gap_px, 4);
}

TEST(SlopeEdges, EvenlySlantedWallHasNone) {
  EXPECT_TRUE(find(scene_of({2000, 2100, 2200, 2300, 2400})).empty());
}

TEST(SlopeEdges, ColorRaisesAWeakEdgeInTheLightAlone) {
  Scene scene = scene_of({2000, 2000, 2000, 2050, 2050, 2050});
  scene.params.threshold_mm_per_px = 100.0;
  paint(scene, {200, 200, 200, 40, 40, 40});
  EXPECT_TRUE(find(scene).empty());
  scene.alpha_ratio = 0.3;
  EXPECT_EQ(find(scene).size(), 1u);
  scene.frame.depth_registered = false;
  EXPECT_TRUE(find(scene).empty());
}

}  // namespace
}  // namespace roomwise::landmark
