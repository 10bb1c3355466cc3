#include <gtest/gtest.h>

#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/landmark_svc/support/kinect_effects.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/synthetic_room.h"

namespace roomwise::landmark {
namespace {

RgbdFrame clutter(const RgbdFrame& frame) {
  RgbdFrame result = frame;
  for (std::size_t i = 0; i < result.depth.steps.size(); ++i) {
    result.depth.steps[i] = i % 8 < 4 ? std::uint16_t{1000} : std::uint16_t{3000};
  }
  return result;
}

/// Allocations of detect() on `frame` after a first, empty frame of that size.
long allocations_on(const RgbdFrame& frame, const char* method) {
  LandmarkParams params;
  params.method = method;
  LandmarkDetector detector(params);
  RgbdFrame first = frame;
  std::fill(first.depth.steps.begin(), first.depth.steps.end(), std::uint16_t{0});
  EXPECT_EQ(detector.detect(first, Pose2{}), DetectResult::kOk);
  const long before = allocations_so_far();
  const DetectResult result = detector.detect(frame, Pose2{});
  const long after = allocations_so_far();
  EXPECT_EQ(result, DetectResult::kOk);
  return after - before;
}

TEST(LandmarkDetector, AllocatesNothingAfterTheFirstFrame) {
  RgbdFrame room = render(furnished_room(), {}, {}, 0);
  add_dropouts(room.depth, 0.05, 1);
  const RgbdFrame full = clutter(room);
  for (const char* method : {"disparity", "thesis"}) {
    EXPECT_EQ(allocations_on(room, method), 0) << method;
    EXPECT_EQ(allocations_on(full, method), 0) << method;
  }
}

TEST(LandmarkDetector, ThisTestCountsAllocations) {
  const long before = allocations_so_far();
  std::vector<int> memory;
  memory.reserve(100);
  EXPECT_EQ(allocations_so_far(), before + 1);
}

}  // namespace
}  // namespace roomwise::landmark
