#include "logs/tools/log_replay.h"

#include <fmt/core.h>

#include <stdexcept>

#include "common/bus/log_file.h"
#include "logs/tools/progress.h"

namespace roomwise {

void LogReading::raise_complaints(const std::filesystem::path& path) const {
  std::string text = damage;
  for (const auto& [channel, seen] : statistics.channels) {
    if (seen.undecodable == 0) continue;
    text += fmt::format("{}{}: {} undecodable messages on {}", text.empty() ? "" : "\n",
                        path.string(), seen.undecodable, channel);
  }
  for (const auto& [reason, count] : statistics.counters) {
    text +=
        fmt::format("{}{}: {} times {}", text.empty() ? "" : "\n", path.string(), count, reason);
  }
  if (!text.empty()) throw std::runtime_error(text);
}

LogReading replay_log(const std::filesystem::path& path, const std::function<void(Bus&)>& subscribe,
                      LogBus::Tap tap) {
  LogReader reader(path);
  Progress progress(path.filename().string(), reader.size_bytes());
  LogBus bus(
      [&](LogEvent& event) {
        progress.show(reader.position_bytes());
        return reader.next(event);
      },
      [](const LogEvent&) {}, std::move(tap));
  subscribe(bus);
  bus.run();
  return {reader.size_bytes(), reader.damage_report(), bus.statistics()};
}

}  // namespace roomwise
