#pragma once
#include <sys/types.h>

#include <filesystem>

#include "services/create_driver/device/file_descriptor.h"

namespace roomwise::create {

/// The guardian process of one open port, seen from the driver: it gets a beat now and then and
/// answers. When the beats end, by death, SIGSTOP or a hang, it stops the robot on its own
/// (guardian.cpp). A program of its own, started with posix_spawn: the driver has LCM's threads,
/// and a copy of all of it would be neither small nor safe.
class Guardian {
 public:
  /// Starts `program` to watch over the robot on `port_fd`. Throws std::runtime_error if it does
  /// not answer within a second.
  Guardian(const std::filesystem::path& program, int port_fd);
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  /// Lets go: the guardian stops the robot and ends; waits for that, half a second at most.
  ~Guardian();

  /// Tells it that the driver lives. False: it is dead or frozen, and nobody must drive without it.
  [[nodiscard]] bool beat();

  pid_t pid() const { return pid_; }

 private:
  void start(const std::filesystem::path& program, int child_end, int port_fd);
  bool answers_within(int patience_ms) const;
  bool has_ended() const;

  pid_t pid_ = -1;
  FileDescriptor line_;
  int unanswered_ = 0;
};

/// Where the guardian's program is: beside this one.
std::filesystem::path guardian_program();

}  // namespace roomwise::create
