#pragma once
#include "common/bus/bus.h"

namespace roomwise {

/// Keeps SIGINT and SIGTERM from ending the process by themselves while it lives.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals();
};

/// While it lives, SIGINT or SIGTERM stops `bus`: the next one, or one that came already. One at a
/// time in a process, inside the life of a StopSignals.
class StopOnSignal {
 public:
  explicit StopOnSignal(Bus& bus);
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
  ~StopOnSignal();
};

}  // namespace roomwise
