// pilot_goal: gives pilot_svc a goal from the command line and says what becomes of it.
#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "common/bus/lcm_bus.h"
#include "common/bus/lcm_url.h"
#include "common/channels.h"

namespace roomwise {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kPatience = seconds(10);

const std::map<std::string, int> kBehaviours = {
    {"stop", pilot_goal_t::BEHAVIOUR_STOP},
    {"wander", pilot_goal_t::BEHAVIOUR_WANDER},
    {"circle", pilot_goal_t::BEHAVIOUR_CIRCLE},
    {"go_to", pilot_goal_t::BEHAVIOUR_GO_TO},
};

/// Gives the goal again and again until a PILOT_STATE names it, then waits for its end if asked to.
class GoalGiver {
 public:
  GoalGiver(const std::string& url, const pilot_goal_t& goal, bool until_done)
      : bus_(url), goal_(goal), until_done_(until_done) {
    goal_.utime = utime_of(bus_.now());
    goal_.source = "pilot_goal";
    started_ = bus_.now();
    bus_.subscribe(channels::kPilotState, [this](const pilot_state_t& m) { on_state(m); });
    bus_.every(milliseconds(200), [this](Time now) { give(now); });
  }

  /// What is to be said on standard error; empty if all went well.
  std::string run() {
    bus_.run();
    return trouble_;
  }

 private:
  void give(Time now) {
    if (is_taken_) return;
    if (now - started_ > kPatience) return end("no pilot_svc answers");
    bus_.publish(channels::kPilotGoal, goal_);
  }

  void on_state(const pilot_state_t& state) {
    if (state.goal_utime != goal_.utime) {
      if (is_taken_) end("another goal came after this one");
      return;
    }
    is_taken_ = true;
    if (state.state == pilot_state_t::STATE_FAILED) return end("failed: " + state.explanation);
    const bool is_done =
        state.state == pilot_state_t::STATE_DONE || state.state == pilot_state_t::STATE_IDLE;
    if (!until_done_ || is_done) end("");
  }

  void end(const std::string& trouble) {
    trouble_ = trouble;
    bus_.stop();
  }

  LcmBus bus_;
  pilot_goal_t goal_;
  bool until_done_;
  bool is_taken_ = false;
  Time started_{};
  std::string trouble_;
};

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  roomwise::pilot_goal_t goal{};
  goal.circle_distance_m = 0.5;
  goal.circle_rounds_ratio = 1.0;
  int behaviour = 0;
  int sense = 1;
  std::string url = roomwise::default_lcm_url();
  bool until_done = false;
  CLI::App app("Gives pilot_svc a goal. Ctrl-C does not take it back: pilot_goal stop does.");
  app.add_option("behaviour", behaviour, "stop, wander, circle or go_to")
      ->required()
      ->transform(CLI::CheckedTransformer(roomwise::kBehaviours));
  app.add_option("--speed_mps", goal.goal_speed_mps, "at most; 0: pilot_svc's own choice");
  app.add_option("--duration_s", goal.goal_duration_s, "done after that long; 0: no limit");
  app.add_option("--x_m", goal.goal_x_m, "of go_to, map frame");
  app.add_option("--y_m", goal.goal_y_m, "of go_to, map frame");
  app.add_option("--distance_m", goal.circle_distance_m, "of circle, rim to object");
  app.add_option("--sense", sense, "of circle: 1 counter-clockwise, -1 clockwise")
      ->check(CLI::IsMember({-1, 1}));
  app.add_option("--rounds", goal.circle_rounds_ratio, "of circle");
  app.add_flag("--until_done", until_done, "wait until it is done or has failed");
  app.add_option("--url", url, "LCM URL, for LCM_DEFAULT_URL");
  CLI11_PARSE(app, argc, argv);
  goal.behaviour = static_cast<std::int8_t>(behaviour);
  goal.circle_sense = static_cast<std::int8_t>(sense);
  try {
    const std::string trouble = roomwise::GoalGiver(url, goal, until_done).run();
    if (trouble.empty()) return 0;
    std::cerr << "pilot_goal: " << trouble << "\n";
  } catch (const std::exception& error) {
    std::cerr << "pilot_goal: " << error.what() << "\n";
  }
  return 1;
}
