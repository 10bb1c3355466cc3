#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/bus/log_event.h"
#include "common/bus/log_file.h"

namespace roomwise {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_log(const std::filesystem::path& path, const std::vector<LogEvent>& events) {
  LogWriter log(path);
  for (const LogEvent& event : events) log.write(event);
  log.close();
}

/// What `act` throws as std::exception, in words; "" if nothing.
template <class Act>
std::string complaint_of(Act act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace roomwise
