#pragma once
#include <string>
#include <vector>

#include "common/params/params.h"

namespace roomwise {

/// What a command line says of one parameter.
struct ParamSetting {
  ParamField field;
  std::vector<std::string> texts;
};

}  // namespace roomwise
