#include "services/pilot_svc/core/goal.h"

#include <cmath>

namespace roomwise::pilot {
namespace {

bool is_within(double value, double least, double largest) {
  return value >= least && value <= largest;  // false for NaN
}

bool is_sound_circle(const Goal& goal) {
  return is_within(goal.circle_distance_m, 0.2, 1.5) && std::abs(goal.circle_sense) == 1 &&
         is_within(goal.circle_rounds, 0.05, 100.0);
}

}  // namespace

bool is_sound(const Goal& goal) {
  if (goal.behaviour == Behaviour::kStop) return true;
  if (!is_within(goal.speed_mps, 0.0, 0.5) || !is_within(goal.duration_s, 0.0, 1e6)) return false;
  if (goal.behaviour == Behaviour::kCircle) return is_sound_circle(goal);
  if (goal.behaviour == Behaviour::kWander) return true;
  return is_within(goal.x_m, -1e4, 1e4) && is_within(goal.y_m, -1e4, 1e4);
}

}  // namespace roomwise::pilot
