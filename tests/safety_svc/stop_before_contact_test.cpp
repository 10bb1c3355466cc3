// Somebody asks for full speed at a wall, a mirror, a table's edge and a stair: the real services
// stop the simulated robot before it touches anything or loses the floor. Two drives go on side by
// side, each on a bus of its own: more would keep two cores so busy that the robot's guardian is
// right to stop it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <map>
#include <thread>

#include "tests/safety_svc/support/safety_chain.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

constexpr std::size_t kAtOnce = 2;

struct Approach {
  const char* name;
  const char* thing;  ///< in TOML, somewhere about x = 2.5 m ahead
  int port;
};

const Approach kApproaches[] = {
    {"Wall", R"(
[[wall]]
points_m = [[2.5, -2.0], [2.5, 2.0]]
material = "plain"
)",
     27751},
    {"Mirror", R"(
[[panel]]
at_m = [2.5, 0.0]
heading_rad = 3.14159
size_m = [1.6, 1.7]
low_m = 0.1
material = "mirror"
[[wall]]
points_m = [[2.6, -2.0], [2.6, 2.0]]
material = "plain"
)",
     27752},
    {"TableEdge", R"(
[[table]]
at_m = [2.7, 0.0]
size_m = [0.7, 1.4, 0.45]
material = "plain"
)",
     27753},
    {"Stair", R"(
[[pit]]
least_m = [2.2, -2.0]
largest_m = [5.0, 2.0]
depth_m = 1.8
steps = 9
tread_m = 0.28
riser_m = 0.18
steps_from = "west"
material = "plain"
)",
     27754},
};

std::string scenario(const Approach& approach) {
  return std::string(R"(
[robot]
at_m = [0.0, 0.0]
[camera]
z_m = 0.4
pitch_down_rad = 0.1
[light]
ambient = 0.6
[[material]]
name = "plain"
pattern = "noise"
color = [0.6, 0.6, 0.55]
second_color = [0.5, 0.5, 0.45]
[[material]]
name = "mirror"
color = [0.9, 0.9, 0.92]
mirror = 0.95
[[floor]]
least_m = [-6.0, -6.0]
largest_m = [6.0, 6.0]
material = "plain"
)") + approach.thing;
}

/// What became of one drive.
struct Outcome {
  bool has_driven = false;
  bool stands = false;
  int contacts = 0;
  int mode_drops = 0;
  double ends_at_m = 0.0;
  double fastest_mps = 0.0;
  std::string reason;
  std::string output;
};

Outcome drive_at(const Approach& approach) {
  ChainSetup setup;
  setup.url = "udpm://239.255.76.67:" + std::to_string(approach.port) + "?ttl=0";
  setup.scenario = scenario(approach);
  setup.speed_mps = 0.5;
  SafetyChain chain(setup);
  Outcome outcome;
  std::size_t standing = 0;
  double last_x_m = 0.0;
  chain.listen_until(
      [&] {
        outcome.fastest_mps = std::max(outcome.fastest_mps, chain.true_speed_mps());
        if (chain.truth.empty()) return false;
        const double x_m = chain.truth.back().true_x_m;
        standing = std::abs(x_m - last_x_m) < 1e-4 ? standing + 1 : 0;
        last_x_m = x_m;
        return x_m > 0.3 && standing > 100;
      },
      30.0);
  for (const truth_t& truth : chain.truth)
    outcome.contacts = std::max(outcome.contacts, truth.contacts);
  outcome.has_driven = last_x_m > 0.3;
  outcome.stands = standing > 100;
  outcome.ends_at_m = last_x_m;
  outcome.mode_drops = chain.states.empty() ? -1 : chain.states.back().mode_drops;
  if (!chain.safety_states.empty()) outcome.reason = chain.safety_states.back().reason_text;
  outcome.output = chain.output();
  return outcome;
}

class StopBeforeContact : public ::testing::TestWithParam<Approach> {
 protected:
  static void SetUpTestSuite() {
    enter_private_network();
    std::deque<std::shared_future<Outcome>> on_their_way;
    for (const Approach& approach : kApproaches) {
      std::shared_future<Outcome> before;
      if (on_their_way.size() == kAtOnce) {
        before = on_their_way.front();
        on_their_way.pop_front();
      }
      const auto drive = [before, approach] {
        if (before.valid()) before.wait();
        return drive_at(approach);
      };
      on_their_way.push_back(std::async(std::launch::async, drive).share());
      drives()[approach.name] = on_their_way.back();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  static std::map<std::string, std::shared_future<Outcome>>& drives() {
    static std::map<std::string, std::shared_future<Outcome>> running;
    return running;
  }
};

TEST_P(StopBeforeContact, AtFullSpeed) {
  const Outcome outcome = drives().at(GetParam().name).get();
  std::printf("%-10s stands at %.2f m, fastest %.2f m/s, contacts %d, %s\n", GetParam().name,
              outcome.ends_at_m, outcome.fastest_mps, outcome.contacts, outcome.reason.c_str());
  ASSERT_TRUE(outcome.has_driven) << outcome.output;
  EXPECT_TRUE(outcome.stands) << outcome.output;
  EXPECT_EQ(outcome.contacts, 0) << outcome.output;
  EXPECT_EQ(outcome.mode_drops, 0) << "the robot's own cliff sensors had to stop it";
}

INSTANTIATE_TEST_SUITE_P(All, StopBeforeContact, ::testing::ValuesIn(kApproaches),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace roomwise
