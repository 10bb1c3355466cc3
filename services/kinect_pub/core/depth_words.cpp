#include "services/kinect_pub/core/depth_words.h"

#include <cstddef>

#include "common/image/player_words.h"

namespace roomwise::kinect {

void split_players(std::span<std::uint16_t> words, std::span<std::uint8_t> players) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const DepthAndPlayer pixel = unpack_player16(words[i]);
    words[i] = pixel.depth_steps;
    players[i] = pixel.player;
  }
}

void drop_depths_above(int max_mm, std::span<std::uint16_t> depths_mm) {
  const auto limit = static_cast<std::uint16_t>(max_mm);
  for (std::uint16_t& depth : depths_mm) depth = depth > limit ? std::uint16_t{0} : depth;
}

}  // namespace roomwise::kinect
