#pragma once
#include <filesystem>
#include <vector>

#include "common/bus/bus.h"
#include "logs/tools/log_replay.h"

namespace roomwise {

/// Every message of one channel of a log. Throws if the log is damaged.
template <class Message>
std::vector<Message> messages_on(const std::filesystem::path& log,
                                 const Channel<Message>& channel) {
  std::vector<Message> messages;
  replay_log(log, [&](Bus& bus) {
    bus.subscribe(channel, [&](const Message& message) { messages.push_back(message); });
  }).raise_complaints(log);
  return messages;
}

/// The channels of a log's events, in order.
inline std::vector<std::string> channel_order(const std::filesystem::path& log) {
  std::vector<std::string> order;
  replay_log(
      log, [](Bus&) {}, [&](const LogEvent& event) { order.push_back(event.channel); })
      .raise_complaints(log);
  return order;
}

}  // namespace roomwise
