// create_calibrate: drives a Create 2 straight and on the spot, asks where that led, and prints the
// measures of its wheels as parameters. scripts/calibrate starts it.
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>

#include "common/params/params.h"
#include "services/create_driver/calibration_drive.h"

namespace roomwise::create {
namespace {

std::atomic<bool> was_told_to_stop{false};

struct Request {
  std::filesystem::path params_path;
  std::filesystem::path result_path;
  double distance_m = 2.0;
  double turns = 5.0;
};

bool has_typed() {
  pollfd typed{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  return ::poll(&typed, 1, 0) > 0;
}

/// The person's next line, while the robot is kept standing.
std::string answer(CalibrationDrive& drive, const std::string& question) {
  std::cout << question << " " << std::flush;
  drive.stand_while([] { return !has_typed(); });
  std::string line;
  for (char letter = 0; ::read(STDIN_FILENO, &letter, 1) == 1; line += letter) {
    if (letter == '\n') return line;
  }
  throw std::runtime_error("no answer");
}

void ask_leave(CalibrationDrive& drive, const std::string& question) {
  const std::string line = answer(drive, question + " [y/N]");
  if (line != "y" && line != "Y" && line != "yes") throw std::runtime_error("not done");
}

double number(CalibrationDrive& drive, const std::string& question) {
  for (;;) {
    const std::string line = answer(drive, question);
    std::size_t used = 0;
    try {
      const double value = std::stod(line, &used);
      if (used == line.size() && std::isfinite(value)) return value;
    } catch (const std::logic_error&) {
    }
    std::cout << "a number, please\n";
  }
}

StraightRun run_straight(CalibrationDrive& drive, double distance_m) {
  std::cout << "Mark where the robot stands and which way it looks.\n";
  std::cout << "It will drive " << distance_m << " m straight ahead.\n";
  ask_leave(drive, "Is the way clear?");
  StraightRun run;
  run.ticks = drive.straight(distance_m);
  run.forward_m = number(drive, "How many metres did it come forward?");
  run.left_m = number(drive, "How many metres did it come to the left (right: negative)?");
  return run;
}

SpinRun run_spin(CalibrationDrive& drive, double turns) {
  std::cout << "Mark which way the robot looks now.\n";
  std::cout << "It will turn left on the spot " << turns << " times.\n";
  ask_leave(drive, "Is there room?");
  SpinRun run;
  run.ticks = drive.spin(2.0 * std::numbers::pi * turns);
  const double beyond_deg =
      number(drive, "How many degrees beyond that did it turn (short of it: negative)?");
  run.turn_rad = 2.0 * std::numbers::pi * (turns + beyond_deg / 360.0);
  return run;
}

std::string as_toml(const WheelGeometry& geometry) {
  char text[200];
  std::snprintf(text, sizeof text,
                "wheel_base_m = %.5f\nwheel_diameter_m = %.5f\n"
                "left_scale_ratio = %.5f\nright_scale_ratio = %.5f\n",
                geometry.wheel_base_m, geometry.wheel_diameter_m, geometry.left_scale_ratio,
                geometry.right_scale_ratio);
  return text;
}

void calibrate(const Request& request) {
  const auto params = load_params<CreateParams>(request.params_path);
  CalibrationDrive drive(params, was_told_to_stop);
  const StraightRun straight = run_straight(drive, request.distance_m);
  const SpinRun spin = run_spin(drive, request.turns);
  const auto geometry = calibrated(params.wheels, straight, spin);
  if (!geometry) throw std::runtime_error("no Create is like that: measure again");
  std::cout << as_toml(*geometry);
  if (request.result_path.empty()) return;
  std::ofstream result(request.result_path);
  if (!(result << as_toml(*geometry) << std::flush)) {
    throw std::runtime_error("cannot write " + request.result_path.string());
  }
}

int run(int argc, char** argv) {
  Request request;
  CLI::App app{"Measures the wheels of a Create 2", "create_calibrate"};
  app.add_option("--params", request.params_path, "create_driver's parameters")
      ->check(CLI::ExistingFile);
  app.add_option("--result", request.result_path, "file for what was measured");
  app.add_option("--distance", request.distance_m, "metres to drive")->check(CLI::Range(0.2, 10.0));
  app.add_option("--turns", request.turns, "turns on the spot")->check(CLI::Range(0.5, 20.0));
  CLI11_PARSE(app, argc, argv);
  calibrate(request);
  return 0;
}

}  // namespace
}  // namespace roomwise::create

int main(int argc, char** argv) try {
  struct sigaction action {};
  action.sa_handler = [](int) { roomwise::create::was_told_to_stop = true; };
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
  return roomwise::create::run(argc, argv);
} catch (const std::exception& error) {
  std::cerr << "create_calibrate: " << error.what() << "\n";
  return 1;
}
