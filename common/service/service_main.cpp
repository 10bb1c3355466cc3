#include "common/service_main.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <exception>
#include <string>

#include "common/bus/lcm_bus.h"
#include "common/bus/lcm_url.h"
#include "common/service/options.h"
#include "common/service/replay.h"
#include "common/service/self_report.h"
#include "common/service/stop_signals.h"

namespace roomwise {
namespace {

/// What both ways of running share: everything between an open bus and its end.
void run_on(Bus& bus, const std::string& name, const ParamFields& params,
            const ServiceFactory& make_service) {
  SelfReport report(bus, name, to_toml(params));
  const std::shared_ptr<void> service = make_service(bus);
  const StopOnSignal stop(bus);
  bus.run();
  report.publish(bus.now());
}

int run_live(const Options& options, const std::string& name, const ParamFields& params,
             const ServiceFactory& make_service) {
  const std::string url = options.lcm_url.empty() ? default_lcm_url() : options.lcm_url;
  LcmBus bus(url);
  spdlog::info("{}: listening on {}", name, url);
  run_on(bus, name, params, make_service);
  return 0;
}

int run_replay(const Options& options, const std::string& name, const ParamFields& params,
               const ServiceFactory& make_service) {
  Replay replay(name, options);
  const auto start = std::chrono::steady_clock::now();
  run_on(replay.bus(), name, params, make_service);
  replay.finish();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  spdlog::info("{}", replay.summary(elapsed.count()));
  return replay.input_was_whole() ? 0 : 1;
}

}  // namespace

int run_service(std::string_view name_view, int argc, const char* const* argv,
                const ParamFields& params, const ServiceFactory& make_service) {
  const std::string name(name_view);
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>(name, std::make_shared<spdlog::sinks::stderr_sink_st>()));
  spdlog::set_pattern("%v");
  try {
    const ParsedOptions parsed = parse_options(name, argc, argv, params);
    if (!parsed.options) return parsed.exit_status;
    if (!parsed.options->params_path.empty()) load_params_file(parsed.options->params_path, params);
    for (const auto& [field, texts] : parsed.options->settings) apply_text(field, texts, params);
    const StopSignals signals;
    const auto run = parsed.options->is_replay() ? run_replay : run_live;
    return run(*parsed.options, name, params, make_service);
  } catch (const std::exception& error) {
    spdlog::error("{}: {}", name, error.what());
    return 1;
  }
}

}  // namespace roomwise
