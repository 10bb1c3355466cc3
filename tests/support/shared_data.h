#pragma once
#include <cstdlib>
#include <filesystem>

#include "tests/support/build_paths.h"

namespace roomwise {

/// Recordings that are not part of the project: the folder ROOMWISE_DATA, else ../shared/data
/// beside the source tree.
inline std::filesystem::path shared_data() {
  if (const char* folder = std::getenv("ROOMWISE_DATA")) return folder;
  return source_folder() / "../shared/data";
}

}  // namespace roomwise

/// Skips the test, saying what is missing, unless `shared_data() / name` is there.
#define ROOMWISE_NEED_DATA(name)                                                 \
  if (!std::filesystem::exists(roomwise::shared_data() / (name)))                \
  GTEST_SKIP() << "no recording " << (roomwise::shared_data() / (name)).string() \
               << "; put it there or name its folder in ROOMWISE_DATA"
