#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace roomwise {

/// Which part of a log to keep: bytes and times of what stays are as they were.
struct LogCut {
  std::filesystem::path log{};
  std::filesystem::path out{};
  double from_s = 0.0;           ///< after the log's first event
  std::optional<double> to_s{};  ///< after the log's first event, up to but without; none: end
  std::vector<std::string> channels{};  ///< these alone; empty: all
  std::vector<std::string> without{};   ///< not these
};

/// Writes the part; returns how many events it has. Throws std::runtime_error naming the file: if
/// nothing is left, and then `out` stays as it was; if the log was damaged, and then what was whole
/// is written first.
std::uint64_t cut_log(const LogCut& cut);

}  // namespace roomwise
