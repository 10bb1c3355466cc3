#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "common/auth/command_signature.h"

namespace roomwise {

/// The key in force. safety_svc makes a new one whenever it starts: a command that the known key
/// does not fit makes this read the file again, ten times a second at most.
class KeyWatch {
 public:
  explicit KeyWatch(std::filesystem::path path) : path_(std::move(path)) {}

  Signature check(const velocity_command_t& command);

  /// Why there is no key; empty while there is one.
  const std::string& error() const { return error_; }

 private:
  void read_if_due();

  std::filesystem::path path_;
  std::optional<SecretKey> key_;
  std::optional<std::chrono::steady_clock::time_point> read_;
  std::string error_;
};

}  // namespace roomwise
