#pragma once
#include <optional>

#include "services/pilot_svc/core/goal.h"
#include "services/pilot_svc/core/surroundings.h"

namespace roomwise::pilot {

/// Runs round the object that is nearest ahead, its rim a set distance away.
///
/// It drives up to the object, then at right angles to the nearest remembered point on the object's
/// side, at (d, beta) from the robot: with sense s, distance wanted D and lean phi = k (d - D),
///   turn rate = gain (beta - s (pi/2 - phi)) + s v / d.
/// Where something else leaves too little room it keeps to the middle. The camera looks forward and
/// the object is out of view: every so often it stops and turns toward it to see what comes next.
/// Rounds are counted by the robot's own turning, which is 2 pi for any closed way once round.
class Circle {
 public:
  Circle(const Goal& goal, const PilotParams& params);

  Step step(const Surroundings& around);

  double turned_rad() const { return turned_rad_; }
  double object_distance_m() const { return object_distance_m_; }
  /// Share of the rounds that is done.
  double ratio() const;

 private:
  enum class Phase : std::uint8_t { kApproach, kAround, kLook };

  Step approach(const Surroundings& around);
  Step run_around(const Surroundings& around);
  Step look(const Surroundings& around);
  void begin_look(const Surroundings& around);
  bool look_is_due(const Surroundings& around) const;
  void count_turn(const Surroundings& around);
  double wanted_m(const Surroundings& around, double object_m) const;

  /// Nearest point whose bearing, counted toward the object's side, lies between the two.
  std::optional<Eigen::Vector2d> nearest(const Surroundings& around, double from_rad,
                                         double to_rad) const;

  PilotParams params_;
  Goal goal_;
  double speed_mps_;
  double sense_;
  Phase phase_ = Phase::kApproach;
  double searched_rad_ = 0.0;  // turned without an object in sight
  double turned_rad_ = 0.0;
  double object_distance_m_ = 0.0;
  std::optional<double> heading_rad_;  // when last stepped
  Pose2 looked_from_;
  double look_heading_rad_ = 0.0;
  std::optional<Time> looks_since_;
};

}  // namespace roomwise::pilot
