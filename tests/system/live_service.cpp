#include "tests/system/live_service.h"

#include <csignal>

#include "common/bus/lcm_bus.h"
#include "common/bus/log_file.h"

namespace roomwise {

LiveService::LiveService(const std::string& name)
    : name_(name), process_({program(name), "--url", kTestUrl}, folder_.path() / "output") {}

std::optional<health_t> LiveService::next_health() {
  LcmBus bus(kTestUrl);
  std::optional<health_t> heard;
  bus.subscribe(channels::kHealth, [&](const health_t& health) {
    if (health.service != name_) return;
    heard = health;
    bus.stop();
  });
  bool waited = false;
  bus.every(std::chrono::seconds(2), [&](Time) {
    if (waited) bus.stop();
    waited = true;
  });
  bus.run();
  return heard;
}

int LiveService::stop(int signal) {
  process_.send_signal(signal);
  return process_.wait();
}

std::vector<LogEvent> events_on(const std::string& channel, const std::filesystem::path& path) {
  LogReader reader(path);
  std::vector<LogEvent> events;
  for (LogEvent event; reader.next(event);) {
    if (event.channel == channel) events.push_back(event);
  }
  return events;
}

channel_health_t channel_of(const health_t& health, const std::string& channel) {
  for (const channel_health_t& described : health.channels) {
    if (described.channel == channel) return described;
  }
  return {};
}

}  // namespace roomwise
