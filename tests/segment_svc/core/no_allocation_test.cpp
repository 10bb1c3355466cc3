#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/scenes.h"

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

namespace roomwise::segment {
namespace {

GreyClassifier some_classifier() {
  return GreyClassifier({{{60.0, 10.0}, {195.0, 10.0}, {125.0, 10.0}}});
}

/// Allocations of segment() on a real frame and on one of noise, after an empty one of that size.
long allocations_of(const char* model) {
  SegmentParams params;
  params.model = model;
  Segmenter segmenter(params);
  segmenter.set_classifier(some_classifier());
  Segmentation result;
  const RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  RgbdFrame other = frame;
  std::fill(other.depth.steps.begin(), other.depth.steps.end(), std::uint16_t{0});
  segmenter.segment(other, result);
  for (std::size_t i = 0; i < other.depth.steps.size(); ++i) {
    other.depth.steps[i] = static_cast<std::uint16_t>(600 + i * 7919 % 5000);
  }
  const long before = allocations;
  segmenter.segment(frame, result);
  segmenter.segment(other, result);
  segmenter.segment(frame, result);
  return allocations - before;
}

TEST(Segmenter, AllocatesNothingAfterTheFirstFrame) {
  EXPECT_EQ(allocations_of("geometry"), 0);
  EXPECT_EQ(allocations_of("gaussian"), 0);
}

TEST(Segmenter, ThisTestCountsAllocations) {
  const long before = allocations;
  std::vector<int> memory;
  memory.reserve(100);
  EXPECT_EQ(allocations, before + 1);
}

}  // namespace
}  // namespace roomwise::segment
