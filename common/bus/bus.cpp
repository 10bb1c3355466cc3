#include "common/bus/bus.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace roomwise {

void Bus::count(std::string_view what, std::int64_t by) {
  const auto found = statistics_.counters.find(what);
  if (found != statistics_.counters.end()) {
    found->second += by;
  } else {
    statistics_.counters.emplace(what, by);
  }
}

void Bus::add_decoder(std::string_view channel, Decoder decoder) {
  const bool added = decoders_.emplace(channel, std::move(decoder)).second;
  if (!added) throw std::logic_error("second handler for channel " + std::string(channel));
  statistics_.channels.try_emplace(std::string(channel));
}

bool Bus::deliver(std::string_view channel, std::span<const std::uint8_t> bytes) {
  const auto decoder = decoders_.find(channel);
  if (decoder == decoders_.end()) return false;
  ChannelStatistics& seen = statistics_.channels.find(channel)->second;
  const auto start = std::chrono::steady_clock::now();
  seen.last_receipt = start;
  decoder->second(bytes, seen);
  const std::chrono::nanoseconds cost = std::chrono::steady_clock::now() - start;
  seen.handler_total += cost;
  seen.handler_longest = std::max(seen.handler_longest, cost);
  return true;
}

void Bus::count_skipped(std::string_view channel) {
  ++statistics_.channels.find(channel)->second.skipped;
}

void Bus::account(ChannelStatistics& statistics, std::int64_t seq) {
  ++statistics.received;
  if (seq <= statistics.last_seq) {
    ++statistics.restarts;
  } else if (statistics.last_seq > 0) {
    const std::int64_t missed = seq - statistics.last_seq - 1;
    if (__builtin_add_overflow(statistics.missed, missed, &statistics.missed)) {
      statistics.missed = std::numeric_limits<std::int64_t>::max();
    }
  }
  statistics.last_seq = seq;
}

}  // namespace roomwise
