#include "common/service/options.h"

#include <CLI/CLI.hpp>
#include <map>

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
  std::map<std::string, std::vector<std::string>> texts;
  for (const ParamField& field : params.fields()) {
    app.add_option("--" + field.name, texts[field.name])
        ->group("Parameters")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  app.add_flag("--outputs-only", options.outputs_only, "leave the input out of the record")
      ->needs(record);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {.options = std::nullopt, .exit_status = app.exit(error)};
  }
  for (const ParamField& field : params.fields()) {
    if (!texts[field.name].empty()) options.settings.push_back({field, texts[field.name]});
  }
  return {.options = options};
}

}  // namespace roomwise
