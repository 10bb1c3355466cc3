#pragma once
#include <cstdint>

namespace roomwise {

/// A pixel of DEPTH_PLAYER16: bits 15..3 are the depth, bits 2..0 the index of the player it shows.
struct DepthAndPlayer {
  std::uint16_t depth_steps;  ///< 0..8191; 0: no reading
  std::uint8_t player;        ///< 0..7; 0: nobody

  bool operator==(const DepthAndPlayer&) const = default;
};

inline constexpr std::uint16_t kPlayer16DepthMax_steps = 0x1FFF;
inline constexpr std::uint8_t kPlayer16PlayerMax = 7;

constexpr DepthAndPlayer unpack_player16(std::uint16_t word) {
  return {.depth_steps = static_cast<std::uint16_t>(word >> 3U),
          .player = static_cast<std::uint8_t>(word & kPlayer16PlayerMax)};
}

/// The reverse. The caller sees to it that neither is larger than it may be.
constexpr std::uint16_t pack_player16(const DepthAndPlayer& pixel) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(pixel.depth_steps) << 3U | pixel.player);
}

}  // namespace roomwise
