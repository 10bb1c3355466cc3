#pragma once
#include <optional>

#include "services/pilot_svc/core/free_way.h"

namespace roomwise::pilot {

/// A direction to go.
struct Direction {
  double bearing_rad = 0.0;
  double way_m = 0.0;  ///< free along it
};

/// What makes a direction good besides its free way.
struct Preference {
  double reach_m = 0.0;              ///< free way beyond this is worth nothing
  std::optional<double> toward_rad;  ///< bearing of a goal; without one all that is new is good
};

/// Chooses where to go by the floor that can be reached: of 72 directions the one with the largest
///   score = way / reach - turn_cost |turn| / pi - visit_cost * freshness + keep_bonus (if kept),
/// where way is what the robot's whole width can sweep and freshness tells how lately the places
/// along it were visited. The direction it goes has a bonus, so that it does not dither, and is
/// given up only when another is clearly better or its way ends. Straight to a goal is taken
/// whenever the way there is free.
class DirectionChoice {
 public:
  explicit DirectionChoice(const PilotParams& params) : params_(params) {}

  void forget() { kept_heading_rad_.reset(); }

  /// The direction chosen last, as it is now; nothing if there is none or its way is no longer
  /// free.
  std::optional<Direction> kept(const Surroundings& around) const;

  /// Nothing if no direction has `way_min_m` of free way (or all of the preference's reach), not
  /// even with the tight margin.
  std::optional<Direction> choose(const Surroundings& around, const Preference& preference);

 private:
  std::optional<Direction> straight_on(const Surroundings& around,
                                       const Preference& preference) const;
  std::optional<Direction> best_of(const Surroundings& around, const Preference& preference,
                                   double radius_m) const;
  double score(const Surroundings& around, const Preference& preference,
               const Direction& direction) const;

  PilotParams params_;
  std::optional<double> kept_heading_rad_;  // odom frame
};

}  // namespace roomwise::pilot
