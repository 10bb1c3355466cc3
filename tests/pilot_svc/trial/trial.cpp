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

/// Listens for the judge and gives each goal until pilot_svc says it has it.
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
    has_begun_ = is_in_force_ = true;
    judge_.on_pilot_state(state);
    if (state.state == pilot_state_t::STATE_FAILED) bus_.stop();
    if (state.state != pilot_state_t::STATE_DONE) return;
    is_in_force_ = false;
    goal_utime_ = 0;
    if (++goals_done_ == trial_.goals.size()) bus_.stop();
  }

  void look(Time now) {
    if (started_ == Time{}) started_ = now;
    constexpr int kViewsBefore = 30;
    if (!is_in_force_ && views_ >= kViewsBefore) give_goal(now);
    const std::string ended = chain_.ended();
    if (!ended.empty()) return give_up("ended by itself:" + ended);
    if (!has_begun_ && now - started_ > seconds(30)) return give_up("the drive does not begin");
    if (judge_.verdict().lasted_s > trial_.patience_s || was_asked_to_end != 0) bus_.stop();
  }

  void give_goal(Time now) {
    pilot_goal_t goal = trial_.goals.at(goals_done_);
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
  bool is_in_force_ = false;
  std::size_t goals_done_ = 0;
  std::string trouble_;
};

}  // namespace

std::vector<pilot_goal_t> goals_along(const simulator::Scene& scene, const std::string& name) {
  const simulator::Path* path = simulator::find_path(scene, name);
  if (path == nullptr) throw std::runtime_error(scene.name + " has no path " + name);
  std::vector<Eigen::Vector2d> round_m = path->corners_m;
  round_m.push_back(scene.start.position_m());
  std::vector<pilot_goal_t> goals;
  for (int round = 0; round < path->rounds; ++round) {
    for (const Eigen::Vector2d& corner_m : round_m) {
      // The map's frame is where the robot started.
      const Eigen::Vector2d p_map_m = transform(inverse(scene.start), corner_m);
      pilot_goal_t goal{};
      goal.behaviour = pilot_goal_t::BEHAVIOUR_GO_TO;
      goal.goal_x_m = p_map_m.x();
      goal.goal_y_m = p_map_m.y();
      goals.push_back(goal);
    }
  }
  return goals;
}

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
