#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/bus/log_event.h"
#include "roomwise/health_t.hpp"
#include "tests/support/build_paths.h"
#include "tests/support/child_process.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {

/// Where the system tests' bus is: inside the private network nobody else has the port.
inline constexpr const char* kTestUrl = "udpm://239.255.76.67:27667?ttl=0&recv_buf_size=212992";

/// One real service on the test's bus, from start to SIGINT.
class LiveService {
 public:
  explicit LiveService(const std::string& name);

  /// Waits until the service's HEALTH says what `enough` wants; its last HEALTH, or nothing if it
  /// ended or half a minute went by.
  template <class Enough>
  std::optional<health_t> wait_for_health(Enough enough);

  bool is_running() { return process_.is_running(); }
  std::string output() const { return process_.output(); }

  /// Asks it to end; its exit status.
  int stop(int signal);

 private:
  std::optional<health_t> next_health();

  std::string name_;
  ScratchFolder folder_;
  ChildProcess process_;
};

template <class Enough>
std::optional<health_t> LiveService::wait_for_health(Enough enough) {
  for (int i = 0; i < 30; ++i) {
    const auto health = next_health();
    if (health && enough(*health)) return health;
    if (!is_running()) return std::nullopt;
  }
  return std::nullopt;
}

/// Events of `channel` in the log at `path`, in order.
std::vector<LogEvent> events_on(const std::string& channel, const std::filesystem::path& path);

/// What a HEALTH says of one channel: all zero if it does not name it.
channel_health_t channel_of(const health_t& health, const std::string& channel);

}  // namespace roomwise
