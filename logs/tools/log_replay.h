#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "common/bus/bus.h"
#include "common/bus/log_bus.h"

namespace roomwise {

/// How reading a log went.
struct LogReading {
  std::uint64_t size_bytes = 0;
  std::string damage;  ///< a line for each place, by byte; empty if the file is whole
  BusStatistics statistics;

  /// Throws std::runtime_error if the file was damaged, a message could not be decoded, or a
  /// handler counted something amiss on the bus. To be called when what could be read has been put
  /// to use.
  void raise_complaints(const std::filesystem::path& path) const;
};

/// Hands every whole message of the log at `path` to what `subscribe` subscribes on the bus. `tap`
/// sees every event. Throws std::runtime_error naming the file if it cannot be opened.
[[nodiscard]] LogReading replay_log(const std::filesystem::path& path,
                                    const std::function<void(Bus&)>& subscribe,
                                    LogBus::Tap tap = {});

}  // namespace roomwise
