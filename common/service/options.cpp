#include "common/service/options.h"

#include "common/service/param_options.h"

namespace roomwise {

ParsedOptions parse_options(std::string_view service, int argc, const char* const* argv,
                            const ParamFields& params) {
  Options options;
  CLI::App app{"Roomwise service; services/" + std::string(service) + "/README.md says more",
               std::string(service)};
  app.add_option("--params", options.params_path, "TOML file that overrides parameters")
      ->check(CLI::ExistingFile);
  auto* url = app.add_option("--url", options.lcm_url, "LCM URL to listen on, for LCM_DEFAULT_URL");
  auto* replay = app.add_option("--replay", options.replay_path,
                                "LCM log to work through offline, as fast as it goes")
                     ->check(CLI::ExistingFile)
                     ->excludes(url);
  auto* record = app.add_option("--record", options.record_path,
                                "LCM log to write: the input with what this service publishes")
                     ->needs(replay);
  const ParamOptions param_options(app, params);
  app.add_flag("--outputs-only", options.outputs_only, "leave the input out of the record")
      ->needs(record);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {.options = std::nullopt, .exit_status = app.exit(error)};
  }
  options.settings = param_options.settings();
  return {.options = options};
}

}  // namespace roomwise
