#include "services/segment_svc/color_memory.h"

#include <gtest/gtest.h>

#include "common/frames/frame_encoder.h"

namespace roomwise {
namespace {

kinect_frame_t frame_at(std::int64_t utime, std::uint8_t level) {
  kinect_frame_t message{};
  message.utime = utime;
  message.color_fx_px = message.color_fy_px = 100.0;
  ColorImage color{.width_px = 10, .height_px = 10, .rgb = std::vector<std::uint8_t>(300, level)};
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

TEST(ColorMemory, FramesWithoutColorOrWithDamagedColorAreNotRecalled) {
  ColorMemory memory(10'000);
  kinect_frame_t bad = frame_at(1, 1);
  bad.color_data.resize(5);
  memory.keep(bad);
  kinect_frame_t none = frame_at(2, 1);
  none.color_encoding = kinect_frame_t::COLOR_NONE;
  memory.keep(none);
  ColorImage color;
  EXPECT_FALSE(memory.recall(1, color));
  EXPECT_FALSE(memory.recall(2, color));
}

}  // namespace
}  // namespace roomwise
