#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "common/bus/log_bus.h"
#include "common/bus/log_file.h"
#include "common/service/options.h"

namespace roomwise {

/// A service's offline run: a log in, a log out. The record appears under its name only when it is
/// whole; until then it is NAME.part.
class Replay {
 public:
  /// Throws std::runtime_error if a log cannot be opened, or record and input are the same file.
  Replay(const std::string& service, const Options& options);

  LogBus& bus() { return *bus_; }

  /// Completes the record. Throws std::runtime_error if the run was stopped before the log ended;
  /// what there is of the record then stays in NAME.part.
  void finish();

  /// True if every byte of the input was a whole event and every message of ours decodable.
  bool input_was_whole() const;

  /// Lines for a person: what was handled and how fast, and what was wrong with the input.
  std::string summary(double elapsed_s) const;

 private:
  void record_input(const LogEvent& event);
  bool is_own_output(const LogEvent& event) const;

  std::string service_;
  std::filesystem::path replay_path_;
  std::filesystem::path record_path_;
  LogReader reader_;
  std::unique_ptr<LogWriter> writer_;
  std::unique_ptr<LogBus> bus_;
};

}  // namespace roomwise
