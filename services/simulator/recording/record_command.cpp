#include "services/simulator/recording/record_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string_view>

#include "common/service/param_options.h"
#include "services/simulator/recording/recorded_drive.h"

namespace roomwise::simulator {
namespace {

struct RecordOptions {
  std::filesystem::path log_path;
  std::filesystem::path params_path;
  DriveOrder request;
};

void add_options(CLI::App& app, RecordOptions& options) {
  app.add_option("--record", options.log_path, "LCM log to write")->required();
  app.add_option("--path", options.request.path, "path of the scenario to drive")
      ->capture_default_str();
  app.add_option("--seconds", options.request.seconds, "end after that; 0: with the path")
      ->check(CLI::Range(0.0, 86400.0));
  app.add_option("--params", options.params_path, "TOML file that overrides parameters")
      ->check(CLI::ExistingFile);
}

void record(const SimulatorParams& params, const RecordOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const DriveSummary summary = record_drive(params, options.request, options.log_path);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  fmt::print(stderr, "simulator: {} frames, {:.1f} s of driving in {:.1f} s{}\n", summary.frames,
             summary.driven_s, took.count(), summary.arrived ? "" : "; the path goes on");
}

}  // namespace

bool asks_for_recording(int argc, const char* const* argv) {
  return std::any_of(argv, argv + argc, [](std::string_view argument) {
    return argument == "--record" || argument.starts_with("--record=");
  });
}

int record_main(int argc, const char* const* argv) {
  CLI::App app{"Writes the log of a simulated drive; services/simulator/README.md says more",
               "simulator"};
  RecordOptions options;
  add_options(app, options);
  SimulatorParams params;
  const ParamFields fields(params);
  const ParamOptions param_options(app, fields);
  try {
    app.parse(argc, argv);
    if (!options.params_path.empty()) load_params_file(options.params_path, fields);
    for (const auto& [field, texts] : param_options.settings()) apply_text(field, texts, fields);
    record(params, options);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "simulator: {}\n", error.what());
    return 1;
  }
}

}  // namespace roomwise::simulator
