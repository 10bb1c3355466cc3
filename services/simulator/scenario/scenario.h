#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// Something that is to go wrong at a given time; the emulated device knows the names.
struct TimedFault {
  std::string name;
  double at_s = 0.0;   ///< after the start
  double for_s = 0.0;  ///< 0: once, or for good
  double value = 0.0;
  std::string where;  ///< "file:line", for an error about the name
};

/// A scenario file: a world with its true landmarks, and what goes wrong in it.
struct Scenario {
  Scene scene;
  std::vector<TimedFault> faults;
};

/// Reads a scenario; scenarios/README.md says what it may hold. `source` names it in errors. Throws
/// std::runtime_error "source:line: table.key must be ..." on anything unknown, of the wrong type,
/// out of range or missing.
Scenario read_scenario(std::string_view toml, std::string_view source);

/// Reads the file at `path`; the scene is named after it. Throws as read_scenario, and if the file
/// cannot be read.
Scenario load_scenario(const std::filesystem::path& path);

/// The file that `name_or_path` means: itself if it ends in ".toml", else `folder`/name.toml.
/// Throws std::runtime_error, listing the names there are, if there is no such file.
std::filesystem::path find_scenario(const std::string& name_or_path,
                                    const std::filesystem::path& folder);

}  // namespace roomwise::simulator
