#include "common/service/self_report.h"

#include <utility>

namespace roomwise {
namespace {

using std::chrono::steady_clock;

double seconds_of(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

channel_health_t describe(const std::string& channel, const ChannelStatistics& seen) {
  channel_health_t described{};
  described.channel = channel;
  described.received = seen.received;
  described.published = seen.published;
  described.missed = seen.missed;
  described.undecodable = seen.undecodable;
  described.skipped = seen.skipped;
  described.restarts = seen.restarts;
  described.age_s = seen.last_receipt ? 0.0 : -1.0;
  return described;
}

void measure_channel(const ChannelStatistics& seen, steady_clock::time_point now,
                     channel_health_t& described) {
  if (seen.last_receipt) described.age_s = seconds_of(now - *seen.last_receipt);
  const std::int64_t handled = seen.received + seen.undecodable;
  if (handled > 0) {
    described.handler_mean_s = seconds_of(seen.handler_total) / static_cast<double>(handled);
  }
  described.handler_max_s = seconds_of(seen.handler_longest);
}

}  // namespace

SelfReport::SelfReport(Bus& bus, std::string service, std::string params_toml)
    : bus_(bus), service_(std::move(service)), params_toml_(std::move(params_toml)) {
  bus_.every(std::chrono::seconds(1), [this](Time time) { publish(time); });
}

void SelfReport::publish(Time time) {
  health_t health = health_at(time);
  if (!bus_.is_replay()) measure(health);
  bus_.publish(channels::kHealth, health);

  params_t params{};
  params.utime = utime_of(time);
  params.service = service_;
  params.toml = params_toml_;
  bus_.publish(channels::kParams, params);
}

health_t SelfReport::health_at(Time time) {
  const BusStatistics& statistics = bus_.statistics();
  health_t health{};
  health.utime = utime_of(time);
  health.service = service_;
  for (const auto& [channel, seen] : statistics.channels) {
    health.channels.push_back(describe(channel, seen));
  }
  health.channel_count = static_cast<std::int32_t>(health.channels.size());
  for (const auto& [name, count] : statistics.counters) {
    named_count_t counter{};
    counter.name = name;
    counter.count = count;
    health.counters.push_back(counter);
  }
  health.counter_count = static_cast<std::int32_t>(health.counters.size());
  health.last_error = statistics.last_error;
  return health;
}

void SelfReport::measure(health_t& health) {
  const auto now = steady_clock::now();
  const ProcessUse use = process_use();
  const double elapsed_s = seconds_of(now - last_measured_);
  if (elapsed_s > 0.0) health.cpu_ratio = (use.cpu_s - last_use_.cpu_s) / elapsed_s;
  health.memory_bytes = use.memory_bytes;
  health.uptime_s = seconds_of(now - started_);
  auto described = health.channels.begin();
  for (const auto& [channel, seen] : bus_.statistics().channels) {
    measure_channel(seen, now, *described++);
  }
  last_measured_ = now;
  last_use_ = use;
}

}  // namespace roomwise
