#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace roomwise {

/// A program started by a test. Ends with its owner, by SIGKILL if need be.
class ChildProcess {
 public:
  /// Starts `command` (found on PATH unless it has a slash); both its outputs go to `output_path`.
  ChildProcess(const std::vector<std::string>& command, std::filesystem::path output_path);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  bool is_running();
  void send_signal(int signal) const;

  /// Waits for it to end. Exit status, or 128 + the signal that ended it; throws std::runtime_error
  /// with its output if it is still running after `patience`.
  int wait(std::chrono::seconds patience = std::chrono::seconds(60));

  /// What it has written so far.
  std::string output() const;

 private:
  std::string name_;
  std::filesystem::path output_path_;
  pid_t pid_ = -1;
  int status_ = -1;
  bool ended_ = false;
};

/// Runs `command` to its end and returns its exit status; `output` receives what it wrote.
int run_to_end(const std::vector<std::string>& command, std::string& output);

}  // namespace roomwise
