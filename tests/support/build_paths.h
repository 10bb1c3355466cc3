#pragma once
#include <filesystem>
#include <string>

namespace roomwise {

/// The source tree the tests were built from.
std::filesystem::path source_folder();
/// One of the project's programs as just built: "ekf_svc".
std::string program(const std::string& name);
/// A program that only tests start: "made_camera".
std::string test_program(const std::string& name);

}  // namespace roomwise
