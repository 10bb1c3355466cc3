#include "tests/support/build_paths.h"

namespace roomwise {

std::filesystem::path source_folder() { return ROOMWISE_SOURCE_DIR; }

std::string program(const std::string& name) { return ROOMWISE_BUILD_DIR "/bin/" + name; }

std::string test_program(const std::string& name) { return ROOMWISE_BUILD_DIR "/tests/" + name; }

}  // namespace roomwise
