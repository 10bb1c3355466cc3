#include "services/kinect_pub/frame_worker.h"

#include <gtest/gtest.h>

#include "common/frames/frame_decoder.h"
#include "common/image/player_words.h"
#include "tests/kinect_pub/support/made_frames.h"

namespace roomwise {
namespace {

CapturedFrame captured(const RgbdFrame& made) {
  CapturedFrame frame;
  frame.utime = 1'700'000'000'000'000;
  frame.device_time_us = 77;
  frame.depth = made.depth;
  frame.color = made.color;
  frame.depth_camera = {575.8, 575.8, 320.0, 240.0};
  frame.color_camera = {525.0, 525.0, 320.0, 240.0};
  return frame;
}

RgbdFrame through(CapturedFrame frame, const kinect::KinectParams& params) {
  FrameToMessage to_message(params);
  kinect_frame_t message{};
  to_message.convert(frame, message);
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame decoded;
  EXPECT_EQ(decoder.decode(message, decoded), FrameResult::kOk);
  return decoded;
}

TEST(FrameToMessage, MessageDecodesToTheFrameItWasMadeOf) {
  const RgbdFrame made = made_frame(1);
  for (const char* depth_encoding : {"pdz16", "raw16"}) {
    kinect::KinectParams params;
    params.depth_encoding = depth_encoding;
    params.color_encoding = "rgb8";
    const RgbdFrame decoded = through(captured(made), params);
    EXPECT_EQ(decoded.depth.steps, made.depth.steps);
    EXPECT_TRUE(decoded.players.empty());
    EXPECT_EQ(decoded.color.rgb, made.color.rgb);
    EXPECT_EQ(decoded.utime, 1'700'000'000'000'000);
    EXPECT_EQ(decoded.color_camera.fx_px, 525.0);
  }
}

TEST(FrameToMessage, PackedWordsBecomeTheirDepthsAndPlayers) {
  const RgbdFrame made = made_frame(2);
  CapturedFrame frame = captured(made);
  for (std::size_t i = 0; i < made.depth.size(); ++i) {
    frame.depth.steps[i] =
        pack_player16({.depth_steps = std::min<std::uint16_t>(made.depth.steps[i], 8191),
                       .player = static_cast<std::uint8_t>(i % 8)});
  }
  kinect::KinectParams params;
  params.depth_words = "depth_and_player";
  const RgbdFrame decoded = through(frame, params);
  ASSERT_EQ(decoded.players.size(), made.depth.size());
  for (std::size_t i = 0; i < made.depth.size(); ++i) {
    ASSERT_EQ(decoded.depth.steps[i], std::min<std::uint16_t>(made.depth.steps[i], 8191));
    ASSERT_EQ(decoded.players[i], i % 8);
  }
}

TEST(FrameToMessage, DepthsBeyondTheLimitAreNoReadingsInAnyUnit) {
  CapturedFrame frame = captured(made_frame(3));
  frame.depth.steps[0] = 65535;
  frame.depth.steps[1] = 4096;
  frame.depth.steps[2] = 4095;
  kinect::KinectParams params;
  params.depth_max_mm = 4095;
  RgbdFrame decoded = through(frame, params);
  EXPECT_EQ(decoded.depth.steps[0], 0);
  EXPECT_EQ(decoded.depth.steps[1], 0);
  EXPECT_EQ(decoded.depth.steps[2], 4095);
  frame.depth.unit_m = 1e-4;
  decoded = through(frame, params);
  EXPECT_EQ(decoded.depth.steps[0], 0);
  EXPECT_EQ(decoded.depth.steps[1], 4096);
}

TEST(FrameToMessage, FrameWithoutColourSaysSo) {
  CapturedFrame frame = captured(made_frame(4));
  frame.color = {};
  EXPECT_TRUE(through(frame, {}).color.empty());
}

}  // namespace
}  // namespace roomwise
