#include "services/kinect_pub/core/depth_words.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/image/player_words.h"

namespace roomwise::kinect {
namespace {

TEST(DepthWords, EachBitOfAWordIsWhereItBelongs) {
  for (unsigned bit = 0; bit < 16; ++bit) {
    const auto word = static_cast<std::uint16_t>(1U << bit);
    const DepthAndPlayer pixel = unpack_player16(word);
    EXPECT_EQ(pixel.depth_steps, bit < 3 ? 0U : 1U << (bit - 3)) << "bit " << bit;
    EXPECT_EQ(pixel.player, bit < 3 ? 1U << bit : 0U) << "bit " << bit;
  }
}

TEST(DepthWords, EveryWordComesBackFromItsParts) {
  for (unsigned word = 0; word <= 0xFFFF; ++word) {
    const DepthAndPlayer pixel = unpack_player16(static_cast<std::uint16_t>(word));
    ASSERT_LE(pixel.depth_steps, 8191);
    ASSERT_LE(pixel.player, 7);
    ASSERT_EQ(pack_player16(pixel), word);
  }
}

TEST(DepthWords, AnImageIsSplitIntoDepthsAndPlayers) {
  std::vector<std::uint16_t> words = {
      0, 7, 8, 0xFFFF, pack_player16({1220, 2}), pack_player16({3810, 0})};
  std::vector<std::uint8_t> players(words.size());
  split_players(words, players);
  EXPECT_EQ(words, (std::vector<std::uint16_t>{0, 0, 1, 8191, 1220, 3810}));
  EXPECT_EQ(players, (std::vector<std::uint8_t>{0, 7, 0, 7, 2, 0}));
}

TEST(DepthWords, DepthsAboveTheLimitAreNoReadings) {
  std::vector<std::uint16_t> depths = {0, 1, 4095, 4096, 10000, 10001, 65534, 65535};
  drop_depths_above(4095, depths);
  EXPECT_EQ(depths, (std::vector<std::uint16_t>{0, 1, 4095, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace roomwise::kinect
