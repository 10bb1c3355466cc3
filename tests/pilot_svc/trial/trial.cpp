#include "tests/pilot_svc/trial/trial.h"

#include <chrono>
#include <csignal>
#include <stdexcept>

#include "common/bus/lcm_bus.h"
#include "services/simulator/scenario/scenario.h"
#include "tests/pilot_svc/support/kinematic_world.h"

namespace roomwise {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

volatile std::sig_atomic_t was_asked_to_end = 0;

/// Listens for the judge and gives the goal until pilot_svc says it has it.
class Watch {
 public:
  Watch(const Trial& trial, TrialChain& chain)
      : trial_(trial), chain_(chain), bus_(chain.url()), judge_(scene_of(trial.setup)) {
    bus_.subscribe(channels::kTruth, [this](const truth_t& m) { judge_.on_truth(m); });
    bus_.subscribe(channels::kSafetyState,
                   [this](const safety_state_t& m) { judge_.on_safety_state(m); });
    bus_.subscribe(channels::kVelCmd,
                   [this](const velocity_command_t& m) { judge_.on_command(m); });
    bus_.subscribe(channels::kSegments, [this](const segmentation_t&) { ++views_; });
    bus_.subscribe(channels::kPilotState, [this](const pilot_state_t& m) { on_state(m); });
    bus_.every(milliseconds(500), [this](Time now) { look(now); });
    bus_.every(seconds(30), [this](Time) {
      if (has_begun_ && trial_.report) trial_.report(judge_.verdict());
    });
  }

  Verdict run() {
    bus_.run();
    if (!trouble_.empty()) throw std::runtime_error(trouble_ + "\n" + chain_.output());
    return judge_.verdict();
  }

 private:
  void on_state(const pilot_state_t& state) {
    if (goal_utime_ == 0 || state.goal_utime != goal_utime_) return;
    has_begun_ = true;
    judge_.on_pilot_state(state);
    if (state.state == pilot_state_t::STATE_DONE || state.state == pilot_state_t::STATE_FAILED) {
      bus_.stop();
    }
  }

  void look(Time now) {
    if (started_ == Time{}) started_ = now;
    constexpr int kViewsBefore = 30;
    if (!has_begun_ && views_ >= kViewsBefore) give_goal(now);
    const std::string ended = chain_.ended();
    if (!ended.empty()) return give_up("ended by itself:" + ended);
    if (!has_begun_ && now - started_ > seconds(30)) return give_up("the drive does not begin");
    if (judge_.verdict().lasted_s > trial_.patience_s || was_asked_to_end != 0) bus_.stop();
  }

  void give_goal(Time now) {
    pilot_goal_t goal = trial_.goal;
    if (goal_utime_ == 0) goal_utime_ = utime_of(now);
    goal.utime = goal_utime_;
    goal.source = "trial";
    bus_.publish(channels::kPilotGoal, goal);
  }

  void give_up(const std::string& why) {
    trouble_ = why;
    bus_.stop();
  }

  const Trial& trial_;
  TrialChain& chain_;
  LcmBus bus_;
  TrialJudge judge_;
  Time started_{};
  int views_ = 0;
  std::int64_t goal_utime_ = 0;
  bool has_begun_ = false;
  std::string trouble_;
};

}  // namespace

simulator::Scene scene_of(const TrialSetup& setup) {
  if (setup.scenario.find('\n') == std::string::npos) return pilot::scenario_scene(setup.scenario);
  return simulator::read_scenario(setup.scenario, "trial").scene;
}

Verdict run_trial(const Trial& trial) {
  // So that the services end with it.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { was_asked_to_end = 1; });
  TrialChain chain(trial.setup);
  return Watch(trial, chain).run();
}

}  // namespace roomwise
