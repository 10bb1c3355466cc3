#pragma once
#include <cstdint>

namespace roomwise::simulator {

/// What the program on the other side of a frame door wants its camera to make. Heights follow
/// from widths: 4 to 3.
struct FrameRequest {
  int depth_width_px = 640;  ///< 320 or 640
  int color_width_px = 640;  ///< 320 or 640
  bool depth_registered = false;

  bool operator==(const FrameRequest&) const = default;
};

constexpr std::uint64_t pack_request(const FrameRequest& request) {
  return static_cast<std::uint64_t>(request.depth_width_px == 320) |
         static_cast<std::uint64_t>(request.color_width_px == 320) << 1U |
         static_cast<std::uint64_t>(request.depth_registered) << 2U;
}

constexpr FrameRequest unpack_request(std::uint64_t packed) {
  return {.depth_width_px = (packed & 1U) != 0 ? 320 : 640,
          .color_width_px = (packed & 2U) != 0 ? 320 : 640,
          .depth_registered = (packed & 4U) != 0};
}

}  // namespace roomwise::simulator
