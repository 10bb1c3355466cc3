#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/time.h"

namespace roomwise {

/// One message as a log holds it: lcm-logger's time of receipt, channel and undecoded bytes.
struct LogEvent {
  Time time{};
  std::string channel;
  std::vector<std::uint8_t> data;

  bool operator==(const LogEvent&) const = default;
};

}  // namespace roomwise
