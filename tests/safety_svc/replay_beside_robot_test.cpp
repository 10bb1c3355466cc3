// A log of a drive, with its commands and what led to them, is played on the bus of a robot that
// stands ready: it must go on standing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/safety_svc/support/safety_chain.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

ChainSetup setup_on(int port) {
  ChainSetup setup;
  setup.url = "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0";
  setup.safety = {"--floor_seen_from_m", "0.2"};
  return setup;
}

double moved_m(const std::vector<truth_t>& truth) {
  double farthest_m = 0.0;
  for (const truth_t& t : truth) {
    farthest_m = std::max(farthest_m, std::hypot(t.true_x_m - truth.front().true_x_m,
                                                 t.true_y_m - truth.front().true_y_m));
  }
  return farthest_m;
}

TEST(ReplayBesideRobot, MovesNothing) {
  enter_private_network();
  SafetyChain recorded(setup_on(27840));
  recorded.start_log();
  ASSERT_TRUE(recorded.listen_until([&] { return recorded.true_speed_mps() > 0.29; }, 20.0))
      << recorded.output();
  recorded.listen_for(1.0);

  SafetyChain standing(setup_on(27841));
  standing.asks = false;
  const auto is_ready = [&] {
    return !standing.safety_states.empty() &&
           standing.safety_states.back().reason_text.find("nobody asks") == 0;
  };
  ASSERT_TRUE(standing.listen_until(is_ready, 20.0)) << standing.output();
  standing.play(recorded.end_log());
  standing.listen_for(6.0);
  EXPECT_LT(moved_m(standing.truth), 1e-6);
  const create_state_t& state =
      *std::ranges::max_element(standing.states, {}, &create_state_t::utime);
  EXPECT_GT(state.refused_forged + state.refused_expired + state.refused_other_session, 30);
}

}  // namespace
}  // namespace roomwise
