#pragma once
#include <filesystem>
#include <string>

namespace roomwise {

/// What `rwlog info` says of a log.
struct LogInfo {
  std::string text;    ///< a summary, then a table with a row for each channel
  std::string damage;  ///< a line for each damaged place, by byte; empty if the file is whole
};

/// Throws std::runtime_error naming the file if it cannot be read.
LogInfo describe_log(const std::filesystem::path& path);

}  // namespace roomwise
