#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "services/ekf_svc/core/body_observation.h"
#include "services/ekf_svc/core/landmark.h"

namespace roomwise::ekf {

/// One landmark as a frame shows it.
struct Sighting {
  PolarObservation polar;
  std::int32_t identity = -1;  ///< >= 0: known for certain; -1: unknown
  std::int8_t kind = 0;
  bool moving = false;
  Signature signature = {};
};

/// What became of a sighting.
enum class Verdict : std::uint8_t {
  kMatched,            ///< corrected the state
  kAdded,              ///< began a landmark
  kReplaced,           ///< took the place of a landmark that contradicted everything else
  kHeld,               ///< belongs to a landmark, but the robot has hardly moved since the last
  kAmbiguous,          ///< too far from a landmark to be it, too near to be another
  kOutlier,            ///< its identity's landmark is elsewhere
  kTaken,              ///< another sighting in the frame fits that landmark better
  kTentative,          ///< may become a landmark if it is seen again from elsewhere
  kPassedOver,         ///< more sightings in the frame than can be told apart at once
  kMapFixed,           ///< new, but the map is not to change
  kMoving,             ///< on something that moves
  kBudgetFull,         ///< new, but the map is full
  kNotFinite,          ///< NaN or infinite
  kRangeInvalid,       ///< zero, negative or beyond any sensor of the kind
  kBearingInvalid,     ///< more than a turn
  kCovarianceInvalid,  ///< not positive definite, or absurdly large
  kSingular,           ///< the update would have divided by zero
};

/// For HEALTH; in the order of Verdict.
inline constexpr std::array<std::string_view, 17> kVerdictNames{
    "sighting_matched",         "sighting_added",
    "sighting_replaced",        "sighting_held",
    "sighting_ambiguous",       "sighting_outlier",
    "sighting_taken",           "sighting_tentative",
    "sighting_passed_over",     "sighting_map_fixed",
    "sighting_moving",          "sighting_budget_full",
    "sighting_not_finite",      "sighting_range_invalid",
    "sighting_bearing_invalid", "sighting_covariance_invalid",
    "sighting_singular"};

constexpr std::string_view name_of(Verdict verdict) {
  return kVerdictNames[static_cast<std::size_t>(verdict)];
}

/// kMatched if the numbers can be used at all, else what is wrong with them.
Verdict check(const Sighting& sighting);

}  // namespace roomwise::ekf
