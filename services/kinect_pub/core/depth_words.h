#pragma once
#include <cstdint>
#include <span>

namespace roomwise::kinect {

/// A depth pixel of devices and logs that also say which player it shows: bits 15..3 are the depth
/// in millimetres, bits 2..0 the player's index, 0 for none.
struct DepthAndPlayer {
  std::uint16_t depth_mm;  ///< 0..8191; 0: no reading
  std::uint8_t player;     ///< 0..7

  bool operator==(const DepthAndPlayer&) const = default;
};

constexpr DepthAndPlayer unpack_depth(std::uint16_t word) {
  return {.depth_mm = static_cast<std::uint16_t>(word >> 3U),
          .player = static_cast<std::uint8_t>(word & 7U)};
}

/// The reverse. Depth beyond 13 bits and players beyond 3 bits lose their upper bits.
constexpr std::uint16_t pack_depth(const DepthAndPlayer& pixel) {
  return static_cast<std::uint16_t>((pixel.depth_mm & 0x1FFFU) << 3U | (pixel.player & 7U));
}

/// Replaces each packed word by its depth. One pass.
void unpack_depths(std::span<std::uint16_t> words);

/// Makes 0 (no reading) of every depth above `max_mm`: 65535, which is -1 to some, and whatever
/// else a device says for want of a reading. One pass.
void drop_depths_above(int max_mm, std::span<std::uint16_t> depths_mm);

}  // namespace roomwise::kinect
