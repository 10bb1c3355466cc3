#include "common/frames/frame_decoder.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>

#include "common/frames/frame_encoder.h"

namespace roomwise {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

DepthImage ramp(int width_px, int height_px) {
  DepthImage depth{width_px, height_px, 0.001, {}};
  for (int i = 0; i < width_px * height_px; ++i) {
    depth.steps.push_back(static_cast<std::uint16_t>(i % 97 == 0 ? 0 : 800 + i % 311));
  }
  return depth;
}

ColorImage gradient(int width_px, int height_px) {
  ColorImage color{width_px, height_px, {}};
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      for (const int level : {200 * u / width_px, 200 * v / height_px, 40}) {
        color.rgb.push_back(static_cast<std::uint8_t>(level));
      }
    }
  }
  return color;
}

Eigen::Isometry3d tilted_camera() {
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear() =
      (Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(-std::numbers::pi / 2 - 0.1, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  T_robot_camera.translation() = Eigen::Vector3d(0.05, 0.0, 0.3);
  return T_robot_camera;
}

kinect_frame_t message_of(const DepthImage& depth, std::int8_t depth_encoding,
                          const ColorImage& color = {},
                          std::int8_t color_encoding = kinect_frame_t::COLOR_RGB8) {
  kinect_frame_t message{};
  message.utime = 1'700'000'000'000'001;
  message.seq = 7;
  message.depth_registered = 1;
  FrameEncoder encoder;
  encoder.encode_depth(depth, depth_encoding, message);
  encoder.encode_color(color, color_encoding, 85, message);
  encode_depth_camera({580.0, 581.0, 15.5, 11.5}, message);
  encode_color_camera({520.0, 521.0, 16.5, 12.5}, message);
  encode_pose(tilted_camera(), message);
  return message;
}

kinect_frame_t good_message() {
  return message_of(ramp(32, 24), kinect_frame_t::DEPTH_PDZ16, gradient(40, 30),
                    kinect_frame_t::COLOR_JPEG);
}

FrameResult decode(const kinect_frame_t& message) {
  RgbdFrame frame;
  return FrameDecoder(ColorUse::kDecode).decode(message, frame);
}

/// What becomes of a good message after `damage`.
FrameResult after(const std::function<void(kinect_frame_t&)>& damage) {
  kinect_frame_t message = good_message();
  damage(message);
  return decode(message);
}

TEST(FrameDecoder, GivesBackWhatWasEncoded) {
  for (const std::int8_t encoding : {kinect_frame_t::DEPTH_RAW16, kinect_frame_t::DEPTH_PDZ16}) {
    const DepthImage depth = ramp(64, 48);
    const ColorImage color = gradient(64, 48);
    RgbdFrame frame;
    ASSERT_EQ(FrameDecoder(ColorUse::kDecode).decode(message_of(depth, encoding, color), frame),
              FrameResult::kOk);
    EXPECT_EQ(frame.utime, 1'700'000'000'000'001);
    EXPECT_EQ(frame.seq, 7);
    EXPECT_TRUE(frame.depth_registered);
    EXPECT_EQ(frame.depth.width_px, 64);
    EXPECT_EQ(frame.depth.height_px, 48);
    EXPECT_EQ(frame.depth.unit_m, 0.001);
    EXPECT_EQ(frame.depth.steps, depth.steps);
    EXPECT_EQ(frame.depth_camera.fy_px, 581.0);
    EXPECT_EQ(frame.depth_camera.cx_px, 15.5);
    EXPECT_EQ(frame.color.rgb, color.rgb);
    EXPECT_EQ(frame.color_camera.fx_px, 520.0);
    EXPECT_EQ(frame.color_camera.cy_px, 12.5);
    EXPECT_TRUE(frame.T_robot_camera.isApprox(tilted_camera(), 1e-12));
  }
}

RC_GTEST_PROP(FrameDecoder, GivesBackAnyPose, ()) {
  const auto number = [] { return *rc::gen::inRange(-1000, 1000) / 1000.0; };
  const Eigen::Quaterniond any(number(), number(), number(), number());
  RC_PRE(any.norm() > 0.01);
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear() = any.normalized().toRotationMatrix();
  T_robot_camera.translation() = Eigen::Vector3d(number(), number(), number());
  kinect_frame_t message = good_message();
  encode_pose(T_robot_camera, message);
  RgbdFrame frame;
  RC_ASSERT(FrameDecoder(ColorUse::kSkip).decode(message, frame) == FrameResult::kOk);
  RC_ASSERT(frame.T_robot_camera.isApprox(T_robot_camera, 1e-9));
}

TEST(FrameDecoder, JpegColourIsCloseToWhatWasEncoded) {
  RgbdFrame frame;
  ASSERT_EQ(FrameDecoder(ColorUse::kDecode).decode(good_message(), frame), FrameResult::kOk);
  const ColorImage color = gradient(40, 30);
  ASSERT_EQ(frame.color.rgb.size(), color.rgb.size());
  for (std::size_t i = 0; i < color.rgb.size(); ++i) {
    EXPECT_NEAR(frame.color.rgb[i], color.rgb[i], 12) << "byte " << i;
  }
}

TEST(FrameDecoder, EmptyAndBlackFramesAreFrames) {
  const DepthImage all_invalid{32, 24, 0.001, std::vector<std::uint16_t>(32 * 24, 0)};
  const ColorImage black{32, 24, std::vector<std::uint8_t>(32 * 24 * 3, 0)};
  for (const std::int8_t encoding : {kinect_frame_t::COLOR_RGB8, kinect_frame_t::COLOR_JPEG}) {
    RgbdFrame frame;
    ASSERT_EQ(
        FrameDecoder(ColorUse::kDecode)
            .decode(message_of(all_invalid, kinect_frame_t::DEPTH_PDZ16, black, encoding), frame),
        FrameResult::kOk);
    EXPECT_EQ(frame.depth.steps, all_invalid.steps);
    EXPECT_EQ(frame.color.rgb, black.rgb);
  }
}

TEST(FrameDecoder, AFrameWithoutColourEmptiesTheColourOfTheOneBefore) {
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  ASSERT_EQ(decoder.decode(good_message(), frame), FrameResult::kOk);
  ASSERT_FALSE(frame.color.empty());
  ASSERT_EQ(decoder.decode(message_of(ramp(32, 24), kinect_frame_t::DEPTH_RAW16), frame),
            FrameResult::kOk);
  EXPECT_TRUE(frame.color.empty());
  EXPECT_EQ(frame.color.width_px, 0);
}

TEST(FrameDecoder, SkippedColourIsNotLookedAt) {
  kinect_frame_t message = good_message();
  message.color_width_px = -1;
  message.color_fx_px = kNaN;
  message.color_data = {1, 2, 3};
  RgbdFrame frame;
  EXPECT_EQ(FrameDecoder(ColorUse::kSkip).decode(message, frame), FrameResult::kOk);
  EXPECT_TRUE(frame.color.empty());
}

TEST(FrameDecoder, ADecoderGoesOnAfterABadFrame) {
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  kinect_frame_t cut = good_message();
  cut.depth_data.pop_back();
  cut.color_data.pop_back();
  ASSERT_NE(decoder.decode(cut, frame), FrameResult::kOk);
  ASSERT_EQ(decoder.decode(good_message(), frame), FrameResult::kOk);
  EXPECT_EQ(frame.depth.steps, ramp(32, 24).steps);
}

TEST(FrameDecoder, RefusesBadSizes) {
  const std::int32_t huge = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t side_px :
       {-1, 0, 15, 4097, huge, std::numeric_limits<std::int32_t>::min()}) {
    EXPECT_EQ(after([&](auto& m) { m.depth_width_px = side_px; }), FrameResult::kBadSize)
        << side_px;
    EXPECT_EQ(after([&](auto& m) { m.depth_height_px = side_px; }), FrameResult::kBadSize);
  }
  for (const std::int32_t side_px : {-1, 0, 4097, huge}) {
    EXPECT_EQ(after([&](auto& m) { m.color_width_px = side_px; }), FrameResult::kBadSize)
        << side_px;
    EXPECT_EQ(after([&](auto& m) { m.color_height_px = side_px; }), FrameResult::kBadSize);
  }
}

TEST(FrameDecoder, RefusesDepthThatIsNotOfItsSize) {
  EXPECT_EQ(after([](auto& m) { m.depth_width_px = 33; }), FrameResult::kBadDepth);
  EXPECT_EQ(after([](auto& m) { m.depth_data.pop_back(); }), FrameResult::kBadDepth);
  EXPECT_EQ(after([](auto& m) { m.depth_data.clear(); }), FrameResult::kBadDepth);
  EXPECT_EQ(after([](auto& m) { m.depth_encoding = kinect_frame_t::DEPTH_RAW16; }),
            FrameResult::kBadDepth);
  EXPECT_EQ(after([](auto& m) { m.depth_encoding = 99; }), FrameResult::kBadDepth);
  kinect_frame_t raw = message_of(ramp(32, 24), kinect_frame_t::DEPTH_RAW16);
  raw.depth_data.push_back(0);
  EXPECT_EQ(decode(raw), FrameResult::kBadDepth);
}

TEST(FrameDecoder, RefusesBadDepthUnits) {
  for (const double unit_m : {0.0, -0.001, 0.11, kNaN, kInfinity}) {
    EXPECT_EQ(after([&](auto& m) { m.depth_unit_m = unit_m; }), FrameResult::kBadDepthUnit);
  }
}

TEST(FrameDecoder, RefusesColourThatIsNotOfItsSize) {
  EXPECT_EQ(after([](auto& m) { m.color_width_px = 41; }), FrameResult::kBadColor);
  EXPECT_EQ(after([](auto& m) { m.color_data.resize(m.color_data.size() / 2); }),
            FrameResult::kBadColor);
  EXPECT_EQ(after([](auto& m) { m.color_data.clear(); }), FrameResult::kBadColor);
  EXPECT_EQ(after([](auto& m) { m.color_data.assign(5000, 0x5A); }), FrameResult::kBadColor);
  EXPECT_EQ(after([](auto& m) { m.color_encoding = kinect_frame_t::COLOR_RGB8; }),
            FrameResult::kBadColor);
  EXPECT_EQ(after([](auto& m) { m.color_encoding = 99; }), FrameResult::kBadColor);
}

TEST(FrameDecoder, RefusesBadIntrinsics) {
  for (const double focal_px : {0.0, -580.0, 1e300, kNaN, kInfinity}) {
    EXPECT_EQ(after([&](auto& m) { m.depth_fx_px = focal_px; }), FrameResult::kBadIntrinsics);
    EXPECT_EQ(after([&](auto& m) { m.depth_fy_px = focal_px; }), FrameResult::kBadIntrinsics);
    EXPECT_EQ(after([&](auto& m) { m.color_fx_px = focal_px; }), FrameResult::kBadIntrinsics);
    EXPECT_EQ(after([&](auto& m) { m.color_fy_px = focal_px; }), FrameResult::kBadIntrinsics);
  }
  for (const double centre_px : {-100.0, 1e9, kNaN, -kInfinity}) {
    EXPECT_EQ(after([&](auto& m) { m.depth_cx_px = centre_px; }), FrameResult::kBadIntrinsics);
    EXPECT_EQ(after([&](auto& m) { m.depth_cy_px = centre_px; }), FrameResult::kBadIntrinsics);
    EXPECT_EQ(after([&](auto& m) { m.color_cx_px = centre_px; }), FrameResult::kBadIntrinsics);
    EXPECT_EQ(after([&](auto& m) { m.color_cy_px = centre_px; }), FrameResult::kBadIntrinsics);
  }
}

TEST(FrameDecoder, RefusesBadPoses) {
  for (int i = 0; i < 4; ++i) {
    for (const double part : {1.5, 1e300, kNaN, kInfinity}) {
      EXPECT_EQ(after([&](auto& m) { m.T_robot_camera_quat[i] = part; }), FrameResult::kBadPose);
    }
  }
  EXPECT_EQ(after([](auto& m) { std::fill_n(m.T_robot_camera_quat, 4, 0.0); }),
            FrameResult::kBadPose);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double metres : {-101.0, kNaN, kInfinity}) {
      EXPECT_EQ(after([&](auto& m) { m.T_robot_camera_translation_m[axis] = metres; }),
                FrameResult::kBadPose);
    }
  }
}

TEST(FrameDecoder, EveryResultHasItsOwnCounter) {
  std::set<std::string> names;
  constexpr int kLast = static_cast<int>(FrameResult::kBadPose);
  for (int i = 0; i <= kLast; ++i) {
    names.emplace(counter_name(static_cast<FrameResult>(i)));
  }
  EXPECT_EQ(names.size(), kLast + 1);
  EXPECT_TRUE(names.contains("frame_bad_depth"));
}

kinect_frame_t player_message(const DepthImage& depth, const std::vector<std::uint8_t>& players) {
  kinect_frame_t message = message_of(depth, kinect_frame_t::DEPTH_RAW16);
  FrameEncoder().encode_depth_and_players(depth, players, message);
  return message;
}

RC_GTEST_PROP(FramePlayers, AnyDepthsAndPlayersComeBack, ()) {
  const int width_px = *rc::gen::inRange(16, 40);
  const int height_px = *rc::gen::inRange(16, 40);
  const auto count = static_cast<std::size_t>(width_px * height_px);
  const auto depths = rc::gen::inRange<std::uint16_t>(0, 8192);
  const auto indices = rc::gen::inRange<std::uint8_t>(0, 8);
  const DepthImage depth{width_px, height_px, 0.001,
                         *rc::gen::container<std::vector<std::uint16_t>>(count, depths)};
  const auto players = *rc::gen::container<std::vector<std::uint8_t>>(count, indices);
  RgbdFrame frame;
  RC_ASSERT(FrameDecoder(ColorUse::kSkip).decode(player_message(depth, players), frame) ==
            FrameResult::kOk);
  RC_ASSERT(frame.depth.steps == depth.steps);
  RC_ASSERT(frame.players == players);
}

TEST(FramePlayers, TheWordIsDepthAboveThreeBitsOfPlayerLowByteFirst) {
  DepthImage depth = ramp(32, 24);
  std::vector<std::uint8_t> players(depth.size(), 0);
  depth.steps[0] = 8191;
  depth.steps[1] = 1000;
  players[1] = 5;
  const kinect_frame_t message = player_message(depth, players);
  EXPECT_EQ(message.depth_encoding, 2);
  EXPECT_EQ(message.depth_size, 2 * 32 * 24);
  EXPECT_EQ(message.depth_data[0], 0xF8);
  EXPECT_EQ(message.depth_data[1], 0xFF);
  EXPECT_EQ(message.depth_data[2], (1000 * 8 + 5) & 0xFF);
  EXPECT_EQ(message.depth_data[3], (1000 * 8 + 5) >> 8);
}

TEST(FramePlayers, AFrameWithoutPlayersEmptiesThoseOfTheOneBefore) {
  const DepthImage depth = ramp(32, 24);
  for (const std::int8_t encoding : {kinect_frame_t::DEPTH_RAW16, kinect_frame_t::DEPTH_PDZ16}) {
    FrameDecoder decoder(ColorUse::kSkip);
    RgbdFrame frame;
    const std::vector<std::uint8_t> players(depth.size(), 3);
    ASSERT_EQ(decoder.decode(player_message(depth, players), frame), FrameResult::kOk);
    ASSERT_EQ(frame.players, players);
    ASSERT_EQ(decoder.decode(message_of(depth, encoding), frame), FrameResult::kOk);
    EXPECT_TRUE(frame.players.empty());
    EXPECT_EQ(frame.depth.steps, depth.steps);
  }
}

TEST(FramePlayers, AreRefusedWhereTheWordsAreNotOfTheImagesSize) {
  const DepthImage depth = ramp(32, 24);
  const kinect_frame_t good = player_message(depth, std::vector<std::uint8_t>(depth.size(), 1));
  kinect_frame_t cut = good;
  cut.depth_data.pop_back();
  kinect_frame_t wider = good;
  wider.depth_width_px = 33;
  kinect_frame_t empty = good;
  empty.depth_data.clear();
  for (const kinect_frame_t& bad : {cut, wider, empty}) {
    EXPECT_EQ(decode(bad), FrameResult::kBadDepth);
  }
}

TEST(FramePlayers, WhatHasNoPlaceInAWordIsRefusedNotCutOff) {
  FrameEncoder encoder;
  kinect_frame_t message{};
  DepthImage depth = ramp(32, 24);
  std::vector<std::uint8_t> players(depth.size(), 7);
  EXPECT_NO_THROW(encoder.encode_depth_and_players(depth, players, message));
  players.back() = 8;
  EXPECT_THROW(encoder.encode_depth_and_players(depth, players, message), std::invalid_argument);
  players.back() = 0;
  depth.steps.back() = 8192;
  EXPECT_THROW(encoder.encode_depth_and_players(depth, players, message), std::invalid_argument);
  depth.steps.back() = 8191;
  players.pop_back();
  EXPECT_THROW(encoder.encode_depth_and_players(depth, players, message), std::invalid_argument);
}

TEST(FrameEncoder, RefusesWhatNoDecoderKnows) {
  FrameEncoder encoder;
  kinect_frame_t message{};
  EXPECT_THROW(encoder.encode_depth(ramp(32, 24), 99, message), std::invalid_argument);
  EXPECT_THROW(encoder.encode_color(gradient(32, 24), 99, 85, message), std::invalid_argument);
  DepthImage short_depth = ramp(32, 24);
  short_depth.steps.pop_back();
  ColorImage short_color = gradient(32, 24);
  short_color.rgb.pop_back();
  for (const std::int8_t encoding : {kinect_frame_t::DEPTH_RAW16, kinect_frame_t::DEPTH_PDZ16}) {
    EXPECT_THROW(encoder.encode_depth(short_depth, encoding, message), std::invalid_argument);
  }
  for (const std::int8_t encoding : {kinect_frame_t::COLOR_RGB8, kinect_frame_t::COLOR_JPEG}) {
    EXPECT_THROW(encoder.encode_color(short_color, encoding, 85, message), std::invalid_argument);
  }
}

}  // namespace
}  // namespace roomwise
