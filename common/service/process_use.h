#pragma once
#include <cstdint>

namespace roomwise {

/// What this process has used of the machine.
struct ProcessUse {
  double cpu_s = 0.0;             ///< user and system time since it started
  std::int64_t memory_bytes = 0;  ///< resident now
};

ProcessUse process_use();

}  // namespace roomwise
