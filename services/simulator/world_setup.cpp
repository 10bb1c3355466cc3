#include "services/simulator/world_setup.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "services/simulator/scenario/scenario.h"

namespace roomwise::simulator {
namespace {

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

}  // namespace

SimulatedWorld world_of(const SimulatorParams& params) {
  Scenario scenario = load(params);
  SimulatedCreate::Setup setup = setup_of(params, scenario);
  return {std::move(scenario.scene), std::move(setup)};
}

}  // namespace roomwise::simulator
