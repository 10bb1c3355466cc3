#include "services/landmark_svc/core/player_mask.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr int kBeside_px = 6;  // columns looked at, at 640 px image width

/// Columns that belong to the landmark's near side, from its line on: [begin, end).
struct Columns {
  int begin;
  int end;
};

Columns near_columns(LandmarkKind kind, int beside_px) {
  if (kind == LandmarkKind::kEdgeLeft) return {0, beside_px};
  if (kind == LandmarkKind::kEdgeRight) return {-beside_px, 0};
  return {-beside_px, beside_px};
}

}  // namespace

bool is_on_player(const Landmark& landmark, std::span<const std::uint8_t> players, int width_px) {
  const auto height_px = static_cast<int>(players.size()) / width_px;
  const Columns columns = near_columns(landmark.kind, std::max(1, kBeside_px * width_px / 640));
  const double middle_px = 0.5 * (landmark.v_top_px + landmark.v_bottom_px);
  const int first_px = std::max(0, static_cast<int>(std::ceil(landmark.v_top_px)));
  const int last_px = std::min(height_px - 1, static_cast<int>(std::floor(landmark.v_bottom_px)));
  int looked_at = 0;
  int on_players = 0;
  for (int v = first_px; v <= last_px; ++v) {
    const int line_px =
        static_cast<int>(std::ceil(landmark.u_px + landmark.column_slope * (v - middle_px)));
    const int end = std::min(line_px + columns.end, width_px);
    for (int u = std::max(line_px + columns.begin, 0); u < end; ++u) {
      ++looked_at;
      on_players += players[static_cast<std::size_t>(v * width_px + u)] != 0 ? 1 : 0;
    }
  }
  return 2 * on_players > looked_at;
}

}  // namespace roomwise::landmark
