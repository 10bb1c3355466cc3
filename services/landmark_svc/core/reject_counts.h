#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace roomwise::landmark {

/// Why something that looked like an edge or a landmark was not taken for one.
enum class RejectReason : std::uint8_t {
  kEdgeOutOfRange,    ///< near pixel outside the trusted range
  kEdgeNearTooShort,  ///< near side is a speck or a flying pixel, not a surface
  kEdgeFarTooShort,   ///< far side comes back at once: a hole or a speck
  kEdgeOnSlope,       ///< the near surface's own slope explains the jump
  kChainTooFewRows,
  kChainTooLow,        ///< height span too small
  kChainTooRagged,     ///< columns scatter about their line
  kChainLeaning,       ///< not vertical
  kChainOnLimb,        ///< the outline of something wide and round: it moves with the viewpoint
  kCreaseNotStraight,  ///< a side of it scatters about its line
  kCreaseOffScan,      ///< the two sides' lines cross elsewhere
  kCreaseOnRound,      ///< a circle fits better than two lines
  kCreaseAtEdge,       ///< an edge or a pole stands there already
  kLandmarkUnfit,      ///< position not finite, or at the robot's own origin
  kLandmarkMerged,     ///< a second piece of the same edge, joined to the first
  kLandmarkOverBudget,
};
inline constexpr std::size_t kRejectReasons = 16;

/// The name a count goes by in messages.
constexpr std::string_view name_of(RejectReason reason) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"edge_out_of_range", "edge_near_too_short", "edge_far_too_short", "edge_on_slope",
       "chain_too_few_rows", "chain_too_low", "chain_too_ragged", "chain_leaning", "chain_on_limb",
       "crease_not_straight", "crease_off_scan", "crease_on_round", "crease_at_edge",
       "landmark_unfit", "landmark_merged", "landmark_over_budget"});
  static_assert(kNames.size() == kRejectReasons);
  return kNames[static_cast<std::size_t>(reason)];
}

/// How often each reason applied on one frame.
class RejectCounts {
 public:
  void add(RejectReason reason) { ++counts_[static_cast<std::size_t>(reason)]; }
  std::int64_t of(RejectReason reason) const { return counts_[static_cast<std::size_t>(reason)]; }
  void clear() { counts_.fill(0); }

 private:
  std::array<std::int64_t, kRejectReasons> counts_{};
};

}  // namespace roomwise::landmark
