#pragma once
#include <cstdint>
#include <vector>

namespace roomwise::landmark {

/// Which end of the nearer surface an edge is, as the camera sees it.
enum class EdgeSide : std::uint8_t { kLeft, kRight };

/// The last pixel of a nearer surface before the depth jumps away from the camera.
struct EdgePixel {
  std::int16_t u_px = 0;         ///< column of the near pixel
  std::int16_t v_px = 0;         ///< row
  std::uint16_t near_steps = 0;  ///< depth of the near pixel
  std::uint16_t far_steps = 0;   ///< depth of the first good pixel beyond
  std::uint16_t gap_px = 1;      ///< columns from near to far pixel; > 1 where bad data is bridged
  std::uint8_t near_run_px = 1;  ///< pixels of unbroken surface on the near side, at most 8
  EdgeSide side = EdgeSide::kLeft;
  bool is_open = false;  ///< the far pixel's depth is beyond what is good: an edge in company only

  /// Column step from the edge into the near surface.
  int inward_px() const { return side == EdgeSide::kLeft ? 1 : -1; }
  bool operator==(const EdgePixel&) const = default;
};

inline constexpr int kNearRunMax_px = 10;

}  // namespace roomwise::landmark
