#include "services/simulator/core/kinect/ragged_edges.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace roomwise::simulator {
namespace {

constexpr int kStepWidth_px = 200;
constexpr int kStepHeight_px = 120;
constexpr int kEdge_px = 101;
constexpr int kReach_px = 2;

std::vector<float> step_image() {
  std::vector<float> image;
  for (int i = 0; i < kStepWidth_px * kStepHeight_px; ++i) {
    image.push_back(i % kStepWidth_px < kEdge_px ? 100.0F : 300.0F);
  }
  return image;
}

std::vector<float> ragged(const std::vector<float>& image, std::uint32_t key, int reach_px) {
  RaggedEdges edges;
  edges.resize(kStepWidth_px, kStepHeight_px, reach_px);
  std::vector<float> result(image.size());
  for (int v = 0; v < kStepHeight_px; ++v) {
    edges.copy_row(image, v, 8.0F, key, result.data() + v * kStepWidth_px);
  }
  return result;
}

TEST(RaggedEdges, OnlyPixelsWithinReachOfAnEdgeChangeAndOnlyToTheOtherSide) {
  const std::vector<float> image = step_image();
  const std::vector<float> result = ragged(image, 5, kReach_px);
  int changed = 0;
  for (int i = 0; i < kStepWidth_px * kStepHeight_px; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (result[at] == image[at]) continue;
    ++changed;
    EXPECT_EQ(result[at], 400.0F - image[at]);
    EXPECT_LE(std::abs(i % kStepWidth_px - kEdge_px), kReach_px);
  }
  // Of five shifts of equal chance, one moves the pixel two away from the edge, and so on: about
  // (1 + 2 + 2 + 1) / 5 pixels a row.
  EXPECT_NEAR(changed / static_cast<double>(kStepHeight_px), 1.2, 0.4);
}

TEST(RaggedEdges, AreOthersInAnotherFrameAndTheSameInTheSame) {
  const std::vector<float> image = step_image();
  EXPECT_EQ(ragged(image, 5, kReach_px), ragged(image, 5, kReach_px));
  EXPECT_NE(ragged(image, 5, kReach_px), ragged(image, 6, kReach_px));
}

TEST(RaggedEdges, WithoutReachTheImageStaysAsItIs) {
  const std::vector<float> image = step_image();
  EXPECT_EQ(ragged(image, 5, 0), image);
  EXPECT_THROW(RaggedEdges().resize(10, 10, 5), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::simulator
