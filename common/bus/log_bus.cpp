#include "common/bus/log_bus.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace roomwise {
namespace {

/// Whether `time` is so far that stepping there tick by tick would never end: a hole in the log, or
/// a damaged time stamp.
bool is_far(Time from, Time time) {
  constexpr std::int64_t kFarthest_us = 60'000'000;
  return utime_of(time) < utime_of(from) - kFarthest_us ||
         utime_of(time) - kFarthest_us > utime_of(from);
}

/// LogFile takes any 64-bit number for a time; keep sums of it and a minute from overflowing.
Time clamp_time(Time time) {
  constexpr std::int64_t kLimit_us = std::int64_t{1} << 61;
  return time_from_utime(std::clamp(utime_of(time), -kLimit_us, kLimit_us));
}

}  // namespace

LogBus::LogBus(Source source, Sink sink, Tap tap)
    : source_(std::move(source)), sink_(std::move(sink)), tap_(std::move(tap)) {}

LogBus::LogBus(const std::vector<LogEvent>& input, std::vector<LogEvent>& output)
    : LogBus(
          [&input, i = std::size_t{0}](LogEvent& event) mutable {
            if (i == input.size()) return false;
            event = input[i++];
            return true;
          },
          [&output](const LogEvent& event) { output.push_back(event); }) {}

void LogBus::post(std::function<void()> /*work*/) {
  throw std::logic_error("a replay takes no work from other threads");
}

void LogBus::every(Duration period, Tick tick) {
  periodics_.push_back({.period = period, .tick = std::move(tick)});
}

void LogBus::run() {
  LogEvent event;
  while (!stop_requested()) {
    reached_end_ = !source_(event);
    if (reached_end_) return;
    const Time time = clamp_time(event.time);
    fire_ticks_until(time);
    now_ = time;
    if (tap_) tap_(event);
    deliver(event.channel, event.data);
  }
}

void LogBus::fire_ticks_until(Time time) {
  for (Periodic& periodic : periodics_) {
    if (!periodic.started || is_far(periodic.next, time)) {
      periodic.next = next_multiple(time, periodic.period);
      periodic.started = true;
    }
  }
  while (true) {
    const auto due = std::min_element(periodics_.begin(), periodics_.end(),
                                      [](const auto& a, const auto& b) { return a.next < b.next; });
    if (due == periodics_.end() || due->next > time) return;
    now_ = due->next;
    due->next += due->period;
    due->tick(now_);
  }
}

void LogBus::subscribe_bytes(const std::string&, Delivery) {}

void LogBus::publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) {
  out_.time = now_;
  out_.channel = channel;
  out_.data.assign(bytes.begin(), bytes.end());
  sink_(out_);
}

}  // namespace roomwise
