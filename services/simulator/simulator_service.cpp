#include "services/simulator/simulator_service.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "services/simulator/scenario/scenario.h"
#include "services/simulator/simulator_messages.h"

namespace roomwise::simulator {
namespace {

constexpr Duration kTick{2'000};
constexpr std::int64_t kTruthRate_hz = 60;
constexpr std::int64_t kCameraRate_hz = 30;
constexpr std::int64_t kLandmarkRate_hz = 1;
/// Bytes taken from the port ahead of the line's pace; the rest waits in the terminal, and its
/// writer with it.
constexpr std::size_t kReadAhead = 256;

std::filesystem::path port_link(const SimulatorParams& params) {
  if (!params.create_port.empty()) return params.create_port;
  return fmt::format("/tmp/roomwise-{}/create", ::getuid());
}

Scenario load(const SimulatorParams& params) {
  return load_scenario(find_scenario(params.scenario, ROOMWISE_SCENARIO_FOLDER));
}

Fault fault_of(const TimedFault& timed) {
  std::string text = fmt::format("at_s={},kind={}", timed.at_s, timed.name);
  if (timed.for_s > 0.0) text += fmt::format(",for_s={}", timed.for_s);
  if (timed.value >= 1.0) text += fmt::format(",count={:.0f}", timed.value);
  try {
    return parse_fault(text);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(timed.where + ": " + error.what());
  }
}

SimulatedCreate::Setup setup_of(const SimulatorParams& params, const Scenario& scenario) {
  SimulatedCreate::Setup setup{.robot = params.robot,
                               .interface = params.interface,
                               .battery_ratio = params.battery_ratio,
                               .T_world_robot = {},
                               .faults = {},
                               .seed = static_cast<std::uint64_t>(params.seed)};
  for (const TimedFault& timed : scenario.faults) setup.faults.push_back(fault_of(timed));
  for (const std::string& text : params.fault) setup.faults.push_back(parse_fault(text));
  return setup;
}

SimulatedWorld world_of(const SimulatorParams& params) {
  Scenario scenario = load(params);
  SimulatedCreate::Setup setup = setup_of(params, scenario);
  return {std::move(scenario.scene), std::move(setup)};
}

/// True if something that happens so often happened in the step that ends `now`.
bool is_due(Duration now, std::int64_t rate_hz) {
  const auto count = [rate_hz](Duration t) { return t.count() * rate_hz / 1'000'000; };
  return count(now) != count(now - SimulatedCreate::kStep);
}

Bus& live(Bus& bus) {
  if (bus.is_replay()) throw std::runtime_error("a simulator has no input that could be replayed");
  return bus;
}

}  // namespace

SimulatorService::SimulatorService(Bus& bus, const Params& params)
    : bus_(live(bus)),
      longest_catch_up_(
          std::chrono::duration_cast<Duration>(std::chrono::duration<double>(params.catch_up_s))),
      world_(world_of(params)),
      port_(port_link(params)),
      real_time_(bus.now()) {
  spdlog::info("simulator: {}; Create on {}", world_.scene().name, port_link(params).string());
  bus_.every(kTick, [this](Time) { advance(); });
}

void SimulatorService::advance() {
  if (real_time_.follow(bus_.now())) bus_.count("wall_clock_set");
  const Duration behind = real_time_.elapsed() - world_.now();
  if (behind > longest_catch_up_) {
    real_time_.skip(behind - longest_catch_up_);
    bus_.count("skipped_ms", (behind - longest_catch_up_).count() / 1000);
  }
  listen();
  const Duration until = real_time_.elapsed();
  while (world_.now() + SimulatedCreate::kStep <= until) step();
  answer();
}

void SimulatorService::listen() {
  SimulatedCreate& create = world_.create();
  if (!port_.is_open()) return;
  if (const int baud = port_.host_baud(); baud > 0) create.set_host_baud(baud);
  from_host_.clear();
  port_.read(kReadAhead - std::min(kReadAhead, create.bytes_waiting()), from_host_);
  create.receive(from_host_);
}

void SimulatorService::step() {
  world_.step(to_host_);
  const Duration now = world_.now();
  if (is_due(now, kTruthRate_hz)) {
    truth_t truth = truth_message(world_, real_time_.stamp(now), is_due(now, kLandmarkRate_hz));
    bus_.publish(channels::kTruth, truth);
  }
  if (take_camera_moment_ && is_due(now, kCameraRate_hz)) {
    take_camera_moment_({real_time_.stamp(now), seconds(now), world_.T_world_camera()});
  }
}

void SimulatorService::answer() {
  const SimulatedCreate& create = world_.create();
  if (create.has_port() && !port_.is_open()) port_.reopen();
  if (!create.has_port() && port_.is_open()) port_.hang_up();
  if (const std::size_t lost = port_.write(to_host_); lost > 0) {
    bus_.count("port_bytes_lost", static_cast<std::int64_t>(lost));
  }
  to_host_.clear();
  const std::int64_t line_lost =
      create.bytes_lost() - std::exchange(line_bytes_lost_, create.bytes_lost());
  if (line_lost > 0) bus_.count("line_bytes_lost", line_lost);
}

}  // namespace roomwise::simulator
