#include "services/segment_svc/color_memory.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "common/frames/frame_encoder.h"

namespace roomwise {
namespace {

kinect_frame_t frame_at(std::int64_t utime, std::uint8_t level, int width_px = 10) {
  kinect_frame_t message{};
  message.utime = utime;
  message.color_fx_px = message.color_fy_px = 100.0;
  const auto bytes = static_cast<std::size_t>(3 * 10 * width_px);
  ColorImage color{
      .width_px = width_px, .height_px = 10, .rgb = std::vector<std::uint8_t>(bytes, level)};
  FrameEncoder().encode_color(color, kinect_frame_t::COLOR_RGB8, 90, message);
  return message;
}

TEST(ColorMemory, RecallsAFrameByItsTime) {
  ColorMemory memory(10'000);
  for (int i = 0; i < 5; ++i) memory.keep(frame_at(i, static_cast<std::uint8_t>(10 * i)));
  ColorImage color;
  ASSERT_TRUE(memory.recall(3, color));
  EXPECT_EQ(color.rgb.at(0), 30);
  EXPECT_EQ(color.width_px, 10);
  EXPECT_FALSE(memory.recall(5, color));
}

TEST(ColorMemory, ForgetsTheOldestFirstAndKeepsOneAlways) {
  ColorMemory memory(900);
  for (int i = 0; i < 5; ++i) memory.keep(frame_at(i, 1));
  ColorImage color;
  EXPECT_FALSE(memory.recall(1, color));
  EXPECT_TRUE(memory.recall(2, color));
  EXPECT_TRUE(memory.recall(4, color));
  ColorMemory small(1);
  small.keep(frame_at(7, 1));
  EXPECT_TRUE(small.recall(7, color));
}

/// However their sizes change, what is recalled is what was kept, and only the newest are.
RC_GTEST_PROP(ColorMemory, KeepsTheNewestOfAnySize, ()) {
  constexpr std::size_t kBytesMax = 3000;
  ColorMemory memory(kBytesMax);
  const auto widths_px =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 60)));
  const auto level_of = [](std::size_t i) { return static_cast<std::uint8_t>(i % 251); };
  for (std::size_t i = 0; i < widths_px.size(); ++i) {
    memory.keep(frame_at(static_cast<std::int64_t>(i), level_of(i), widths_px[i]));
  }
  bool is_forgotten = false;
  std::size_t bytes = 0;
  for (std::size_t i = widths_px.size(); i-- > 0;) {
    ColorImage color;
    if (!memory.recall(static_cast<std::int64_t>(i), color)) {
      is_forgotten = true;
      continue;
    }
    RC_ASSERT(!is_forgotten);
    RC_ASSERT(color.width_px == widths_px[i]);
    bytes += color.rgb.size();
    for (const std::uint8_t level : color.rgb) RC_ASSERT(level == level_of(i));
  }
  RC_ASSERT(bytes > 0U);
  RC_ASSERT(bytes <= kBytesMax);
}

TEST(ColorMemory, FramesOfNextToNothingDoNotPileUp) {
  ColorMemory memory(1'000'000);
  for (int i = 0; i <= 1000; ++i) memory.keep(frame_at(i, 1, 1));
  ColorImage color;
  EXPECT_FALSE(memory.recall(0, color));
  EXPECT_TRUE(memory.recall(1, color));
  EXPECT_TRUE(memory.recall(1000, color));
}

TEST(ColorMemory, FramesWithoutColorOrWithDamagedColorAreNotRecalled) {
  ColorMemory memory(10'000);
  kinect_frame_t bad = frame_at(1, 1);
  bad.color_data.resize(5);
  memory.keep(bad);
  kinect_frame_t none = frame_at(2, 1);
  none.color_encoding = kinect_frame_t::COLOR_NONE;
  memory.keep(none);
  kinect_frame_t empty = frame_at(3, 1);
  empty.color_data.clear();
  memory.keep(empty);
  ColorImage color;
  EXPECT_FALSE(memory.recall(1, color));
  EXPECT_FALSE(memory.recall(2, color));
  EXPECT_FALSE(memory.recall(3, color));
}

}  // namespace
}  // namespace roomwise
