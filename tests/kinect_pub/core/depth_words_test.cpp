#include "services/kinect_pub/core/depth_words.h"

#include <gtest/gtest.h>

#include <vector>

namespace roomwise::kinect {
namespace {

TEST(DepthWords, EachBitOfAWordIsWhereItBelongs) {
  for (unsigned bit = 0; bit < 16; ++bit) {
    const auto word = static_cast<std::uint16_t>(1U << bit);
    const DepthAndPlayer pixel = unpack_depth(word);
    EXPECT_EQ(pixel.depth_mm, bit < 3 ? 0U : 1U << (bit - 3)) << "bit " << bit;
    EXPECT_EQ(pixel.player, bit < 3 ? 1U << bit : 0U) << "bit " << bit;
  }
}

TEST(DepthWords, EveryWordComesBackFromItsParts) {
  for (unsigned word = 0; word <= 0xFFFF; ++word) {
    const DepthAndPlayer pixel = unpack_depth(static_cast<std::uint16_t>(word));
    ASSERT_LE(pixel.depth_mm, 8191);
    ASSERT_LE(pixel.player, 7);
    ASSERT_EQ(pack_depth(pixel), word);
  }
}

TEST(DepthWords, PackingCutsWhatHasNoRoom) {
  EXPECT_EQ(unpack_depth(pack_depth({.depth_mm = 0x2000 | 5, .player = 8 | 3})),
            (DepthAndPlayer{.depth_mm = 5, .player = 3}));
}

TEST(DepthWords, UnpackingAnImageLeavesDepthsAlone) {
  std::vector<std::uint16_t> words = {
      0, 7, 8, 0xFFFF, pack_depth({1220, 2}), pack_depth({3810, 0})};
  unpack_depths(words);
  EXPECT_EQ(words, (std::vector<std::uint16_t>{0, 0, 1, 8191, 1220, 3810}));
}

TEST(DepthWords, DepthsAboveTheLimitAreNoReadings) {
  std::vector<std::uint16_t> depths = {0, 1, 4095, 4096, 10000, 10001, 65534, 65535};
  drop_depths_above(4095, depths);
  EXPECT_EQ(depths, (std::vector<std::uint16_t>{0, 1, 4095, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace roomwise::kinect
