#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace roomwise {

/// What became of one channel's messages in this process.
struct ChannelStatistics {
  std::int64_t received = 0;  ///< decoded and handled
  std::int64_t published = 0;
  std::int64_t missed = 0;       ///< by gaps in seq
  std::int64_t undecodable = 0;  ///< wrong size, fingerprint or counts
  std::int64_t skipped = 0;      ///< passed over for a newer one
  std::int64_t restarts = 0;     ///< seq went back: the publisher started anew, or there are two
  std::int64_t last_seq = 0;
  std::optional<std::chrono::steady_clock::time_point> last_receipt;
  std::chrono::nanoseconds handler_total{0};
  std::chrono::nanoseconds handler_longest{0};
};

/// Everything a Bus counts. Ordered maps: the order reaches HEALTH.
struct BusStatistics {
  std::map<std::string, ChannelStatistics, std::less<>> channels;
  std::map<std::string, std::int64_t, std::less<>> counters;
  std::string last_error;
};

}  // namespace roomwise
