#pragma once
#include <cstdint>
#include <span>

#include "services/landmark_svc/core/landmark.h"

namespace roomwise::landmark {

/// Whether a landmark is on somebody the camera's own driver has found: more than half of the
/// pixels beside it, on its near side, over its rows, bear a player's index. Of creases and poles
/// both sides are near. People stand still too, and are then no furniture.
///
/// `players`: height x width, 0 nobody. The index is the Kinect SDK's (NUI_IMAGE_PLAYER_INDEX_MASK,
/// the lower three bits of a depth word).
bool is_on_player(const Landmark& landmark, std::span<const std::uint8_t> players, int width_px);

}  // namespace roomwise::landmark
