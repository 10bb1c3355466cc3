// pilot_trial: lets the real services drive a simulated robot by themselves, in a network of its
// own, and says what became of it by the simulator's truth.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "services/simulator/core/scene.h"
#include "tests/pilot_svc/trial/trial.h"
#include "tests/support/private_network.h"

namespace {

roomwise::pilot_goal_t one_goal(const std::string& behaviour, int sense, double distance_m) {
  using roomwise::pilot_goal_t;
  pilot_goal_t goal{};
  goal.behaviour =
      behaviour == "circle" ? pilot_goal_t::BEHAVIOUR_CIRCLE : pilot_goal_t::BEHAVIOUR_WANDER;
  goal.circle_sense = static_cast<std::int8_t>(sense);
  goal.circle_distance_m = distance_m;
  goal.circle_rounds_ratio = 1.0;
  return goal;
}

}  // namespace

int main(int argc, char** argv) {
  roomwise::Trial trial;
  trial.setup.url = "udpm://239.255.76.67:27667?ttl=0&recv_buf_size=2097152";
  double minutes = 10.0;
  std::string behaviour = "wander";
  std::string log;
  int sense = 1;
  double distance_m = 0.5;
  std::string path = "loop1";
  CLI::App app("Lets the real services drive a simulated robot and judges it by the truth.");
  app.add_option("--scenario", trial.setup.scenario, "of the simulator");
  app.add_option("--seed", trial.setup.seed, "of the simulator");
  app.add_option("--minutes", minutes, "at most");
  app.add_option("--resolution", trial.setup.resolution, "of the camera");
  app.add_option("--behaviour", behaviour, "wander, circle or tour")
      ->check(CLI::IsMember({"wander", "circle", "tour"}));
  app.add_option("--path", path, "of tour: one of the scenario's");
  app.add_option("--sense", sense, "of circle: 1 or -1");
  app.add_option("--distance_m", distance_m, "of circle");
  app.add_option("--log", log, "file for all that is said, without the camera's frames");
  CLI11_PARSE(app, argc, argv);
  trial.setup.log = log;
  trial.patience_s = 60.0 * minutes;
  trial.report = [](const roomwise::Verdict& verdict) { std::cout << verdict << std::endl; };
  try {
    trial.goals = behaviour == "tour" ? roomwise::goals_along(roomwise::scene_of(trial.setup), path)
                                      : std::vector{one_goal(behaviour, sense, distance_m)};
    roomwise::enter_private_network();
    const roomwise::Verdict verdict = roomwise::run_trial(trial);
    std::cout << trial.setup.scenario << ": " << verdict;  // after what is reported on the way
  } catch (const std::exception& error) {
    std::cerr << "pilot_trial: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
