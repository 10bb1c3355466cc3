#include "services/landmark_svc/core/color_weight.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace roomwise::landmark {
namespace {

TEST(ColorWeight, IsZeroInTheDarkAndLargestInTheLight) {
  const ColorWeightParams params;
  EXPECT_EQ(color_weight_ratio(params, 0.0), 0.0);
  EXPECT_EQ(color_weight_ratio(params, params.dark_luma_levels), 0.0);
  EXPECT_DOUBLE_EQ(color_weight_ratio(params, 50.0), 0.5 * params.alpha_max_ratio);
  EXPECT_EQ(color_weight_ratio(params, 255.0), params.alpha_max_ratio);
}

RC_GTEST_PROP(ColorWeight, BrighterNeverWeighsLess, ()) {
  const ColorWeightParams params;
  const double luma_levels = *rc::gen::inRange(0, 255);
  RC_ASSERT(color_weight_ratio(params, luma_levels) <= color_weight_ratio(params, luma_levels + 1));
}

TEST(ColorWeight, MeanLumaOfOneGreyIsThatGrey) {
  EXPECT_EQ(mean_luma_levels({}), 0.0);
  const ColorImage grey{
      .width_px = 40, .height_px = 30, .rgb = std::vector<std::uint8_t>(3600, 77)};
  EXPECT_DOUBLE_EQ(mean_luma_levels(grey), 77.0);
}

RgbdFrame frame_of(int depth_side_px, int color_side_px) {
  RgbdFrame frame;
  frame.depth.width_px = depth_side_px;
  frame.depth.height_px = depth_side_px;
  frame.depth_registered = true;
  frame.color.width_px = color_side_px;
  frame.color.height_px = color_side_px;
  for (int i = 0; i < color_side_px * color_side_px; ++i) {
    frame.color.rgb.insert(frame.color.rgb.end(), 3, static_cast<std::uint8_t>(i));
  }
  return frame;
}

TEST(ColorAtDepth, FollowsAColorImageOfAnotherSize) {
  ColorAtDepth color;
  const RgbdFrame twice = frame_of(4, 8);
  color.attach(twice);
  EXPECT_EQ(color.rgb(3, 2)[0], 4 * 8 + 6);
  const RgbdFrame half = frame_of(8, 4);
  color.attach(half);
  EXPECT_EQ(color.rgb(7, 5)[0], 2 * 4 + 3);
}

TEST(ColorAtDepth, NeedsRegisteredWholeColor) {
  ColorAtDepth color;
  RgbdFrame frame = frame_of(4, 4);
  color.attach(frame);
  EXPECT_TRUE(color.available());
  frame.color.rgb.pop_back();
  color.attach(frame);
  EXPECT_FALSE(color.available());
  frame = frame_of(4, 4);
  frame.depth_registered = false;
  color.attach(frame);
  EXPECT_FALSE(color.available());
}

}  // namespace
}  // namespace roomwise::landmark
