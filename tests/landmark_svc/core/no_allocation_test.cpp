#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/landmark_svc/support/kinect_effects.h"
#include "tests/support/synthetic_room.h"

namespace {
long allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

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
  EXPECT_EQ(detector.detect(first), DetectResult::kOk);
  const long before = allocations;
  const DetectResult result = detector.detect(frame);
  const long after = allocations;
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
  const long before = allocations;
  std::vector<int> memory;
  memory.reserve(100);
  EXPECT_EQ(allocations, before + 1);
}

}  // namespace
}  // namespace roomwise::landmark
