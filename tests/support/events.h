#pragma once
#include <cstdint>

#include "common/bus/log_event.h"
#include "common/bus/wire.h"
#include "common/channels.h"

namespace roomwise {

/// `message` as a log holds it, received at `utime`.
template <class Message>
LogEvent event_of(const Channel<Message>& channel, std::int64_t utime, const Message& message) {
  LogEvent event;
  event.time = time_from_utime(utime);
  event.channel = channel.name;
  encode(message, event.data);
  return event;
}

}  // namespace roomwise
