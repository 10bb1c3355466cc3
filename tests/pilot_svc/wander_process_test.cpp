// The real services, real processes: the robot wanders by itself in a furnished room. `pilot_trial`
// is the same for as long as one likes.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/pilot_svc/trial/trial.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

TEST(WanderProcess, DrivesThroughTheLivingRoomWithoutAContact) {
  enter_private_network();
  Trial trial;
  trial.setup.url = "udpm://239.255.76.67:27768?ttl=0";
  trial.setup.scenario = "living_room";
  trial.goals.emplace_back().behaviour = pilot_goal_t::BEHAVIOUR_WANDER;
  trial.patience_s = 25.0;
  const Verdict verdict = run_trial(trial);
  std::cout << verdict;
  EXPECT_GT(verdict.driven_m, 0.5);
  EXPECT_EQ(verdict.contacts_faster_than(0.1), 0);
  EXPECT_EQ(verdict.falls, 0);
  EXPECT_NE(verdict.last.state, pilot_state_t::STATE_FAILED);
}

}  // namespace
}  // namespace roomwise
