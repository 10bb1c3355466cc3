#pragma once
#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "common/params/params.h"
#include "common/service/param_setting.h"

namespace roomwise {

/// Makes each parameter an option of its own name: --range_noise_m 0.1. Must live while `app`
/// parses.
class ParamOptions {
 public:
  ParamOptions(CLI::App& app, const ParamFields& params);

  /// One entry for each parameter the command line named.
  std::vector<ParamSetting> settings() const;

 private:
  std::vector<ParamField> fields_;
  std::map<std::string, std::vector<std::string>> texts_;
};

}  // namespace roomwise
