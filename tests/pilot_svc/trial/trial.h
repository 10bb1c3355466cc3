#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tests/pilot_svc/trial/trial_chain.h"
#include "tests/pilot_svc/trial/trial_judge.h"

namespace roomwise {

/// A drive by itself, judged from outside.
struct Trial {
  TrialSetup setup;
  std::vector<pilot_goal_t> goals;             ///< the next once one is done
  double patience_s = 60.0;                    ///< from the first PILOT_STATE of a goal on
  std::function<void(const Verdict&)> report;  ///< every half minute
};

/// Starts everything, gives the goals as soon as there is floor to see, and watches until all are
/// done or one has failed or patience ends. Throws std::runtime_error with what the services said
/// if the drive does not begin within half a minute, or one of them ends.
Verdict run_trial(const Trial& trial);

/// Go-to goals along the corners of the scene's path `name`, so many rounds as it has. Throws
/// std::runtime_error if there is no such path.
std::vector<pilot_goal_t> goals_along(const simulator::Scene& scene, const std::string& name);

/// The scene a setup means.
simulator::Scene scene_of(const TrialSetup& setup);

}  // namespace roomwise
