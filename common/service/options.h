#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/params/params.h"
#include "common/service/param_setting.h"

namespace roomwise {

/// What a service's command line says.
struct Options {
  std::filesystem::path params_path;  ///< empty: defaults
  std::string lcm_url;                ///< empty: default_lcm_url()
  std::filesystem::path replay_path;  ///< empty: live
  std::filesystem::path record_path;  ///< empty: nothing is recorded; replay only
  bool outputs_only = false;          ///< record what the service publishes without its input

  std::vector<ParamSetting> settings;  ///< what the command line says of parameters

  bool is_replay() const { return !replay_path.empty(); }
};

/// What parsing a command line came to: options, or an exit status (after --help, or an error that
/// has been said on stderr).
struct ParsedOptions {
  std::optional<Options> options;
  int exit_status = 0;
};

/// Each parameter is an option of its own name as well: --range_noise_m 0.1.
ParsedOptions parse_options(std::string_view service, int argc, const char* const* argv,
                            const ParamFields& params);

}  // namespace roomwise
