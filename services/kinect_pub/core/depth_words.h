#pragma once
#include <cstdint>
#include <span>

namespace roomwise::kinect {

/// Splits packed words (common/image/player_words.h): `words` become their depths, `players`, of
/// the same size, the index of the player each shows. One pass.
void split_players(std::span<std::uint16_t> words, std::span<std::uint8_t> players);

/// Makes 0 (no reading) of every depth above `max_mm`: 65535, which is -1 to some, and whatever
/// else a device says for want of a reading. One pass.
void drop_depths_above(int max_mm, std::span<std::uint16_t> depths_mm);

}  // namespace roomwise::kinect
