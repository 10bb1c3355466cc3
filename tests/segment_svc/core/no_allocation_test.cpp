#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/scenes.h"
#include "tests/segment_svc/support/taught.h"
#include "tests/support/allocation_counter.h"

namespace roomwise::segment {
namespace {

/// Allocations of segment() on a real frame and on one of noise, after an empty one of that size.
long allocations_of(const char* model) {
  SegmentParams params;
  params.model = model;
  Segmenter segmenter(params);
  segmenter.learn(taught_greys({{{60.0, 10.0}, {195.0, 10.0}, {125.0, 10.0}}}));
  Segmentation result;
  const RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  RgbdFrame other = frame;
  std::fill(other.depth.steps.begin(), other.depth.steps.end(), std::uint16_t{0});
  segmenter.segment(other, result);
  for (std::size_t i = 0; i < other.depth.steps.size(); ++i) {
    other.depth.steps[i] = static_cast<std::uint16_t>(600 + i * 7919 % 5000);
  }
  const long before = allocations_so_far();
  segmenter.segment(frame, result);
  segmenter.segment(other, result);
  segmenter.segment(frame, result);
  return allocations_so_far() - before;
}

TEST(Segmenter, AllocatesNothingAfterTheFirstFrame) {
  EXPECT_EQ(allocations_of("geometry"), 0);
  EXPECT_EQ(allocations_of("gaussian"), 0);
  EXPECT_EQ(allocations_of("mixture"), 0);
  EXPECT_EQ(allocations_of("fused"), 0);
}

TEST(Segmenter, ThisTestCountsAllocations) {
  const long before = allocations_so_far();
  std::vector<int> memory;
  memory.reserve(100);
  EXPECT_EQ(allocations_so_far(), before + 1);
}

}  // namespace
}  // namespace roomwise::segment
