#pragma once
#include <functional>

#include "tests/pilot_svc/trial/trial_chain.h"
#include "tests/pilot_svc/trial/trial_judge.h"

namespace roomwise {

/// A drive by itself, judged from outside.
struct Trial {
  TrialSetup setup;
  pilot_goal_t goal{};
  double patience_s = 60.0;                    ///< from the first PILOT_STATE of the goal on
  std::function<void(const Verdict&)> report;  ///< every half minute
};

/// Starts everything, gives the goal as soon as there is floor to see, and watches until the goal
/// is done or failed or patience ends. Throws std::runtime_error with what the services said if the
/// drive does not begin within half a minute, or one of them ends.
Verdict run_trial(const Trial& trial);

/// The scene a setup means.
simulator::Scene scene_of(const TrialSetup& setup);

}  // namespace roomwise
