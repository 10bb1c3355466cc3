#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus_statistics.h"
#include "common/bus/wire.h"
#include "common/channels.h"
#include "common/time.h"

namespace roomwise {

/// Which messages a subscriber is handed when it cannot keep up with a live stream. Offline every
/// message is handed on, whatever is asked for.
enum class Delivery {
  kEvery,   ///< all of them, in order of arrival
  kLatest,  ///< only the newest; those passed over are counted as skipped
};

/// The one door between a service and the world. Handlers and ticks run one at a time, on the
/// thread that calls run(). An exception in a handler leaves run(): it is a bug of ours.
///
/// Undecodable messages never reach a handler; they, gaps in `seq`, skipped and published messages
/// are counted in statistics(), which service_main publishes on HEALTH.
class Bus {
 public:
  using Tick = std::function<void(Time)>;

  Bus() = default;
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  virtual ~Bus() = default;

  /// Calls `handler(message)` for every message on `channel`. One handler a channel; throws
  /// std::logic_error on a second.
  template <class Message, class Handler>
  void subscribe(const Channel<Message>& channel, Handler handler,
                 Delivery delivery = Delivery::kEvery);

  /// The same for a handler that passes on what was received: `handler(bytes)`, of a whole message.
  template <class Message, class Handler>
  void subscribe_undecoded(const Channel<Message>& channel, Handler handler,
                           Delivery delivery = Delivery::kEvery);

  /// Sends `message` after setting its `seq`, which counts from 1 per channel.
  template <class Message>
  void publish(const Channel<Message>& channel, Message& message);

  /// Calls `tick` once every `period`, at whole multiples of it since the epoch, with that nominal
  /// time. Live, periods missed while a handler ran are left out.
  virtual void every(Duration period, Tick tick) = 0;

  /// Runs `work` soon on the thread that is in run(): how a thread of a service's own (a camera's)
  /// reaches the bus. May be called from any thread. Only live: throws std::logic_error in a
  /// replay, which must not depend on threads.
  virtual void post(std::function<void()> work) = 0;

  /// Live: the wall clock (from any thread). Offline: the time of the log event being handled.
  virtual Time now() const = 0;

  /// Hands out messages and ticks until stop(), or offline until the log ends.
  virtual void run() = 0;

  /// True if time comes from a log: nothing measured on this machine belongs in the output.
  virtual bool is_replay() const = 0;

  /// Makes run() return soon. May be called from a signal handler or another thread.
  void stop() { stop_requested_.store(true); }

  /// Adds to a named counter on HEALTH: bad data by reason.
  void count(std::string_view what, std::int64_t by = 1);

  /// Remembers the newest error in words, for HEALTH.
  void note_error(std::string text) { statistics_.last_error = std::move(text); }

  const BusStatistics& statistics() const { return statistics_; }

 protected:
  virtual void subscribe_bytes(const std::string& channel, Delivery delivery) = 0;
  virtual void publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) = 0;

  /// Decodes and hands `bytes` to the channel's handler. False if nobody subscribed to it.
  bool deliver(std::string_view channel, std::span<const std::uint8_t> bytes);
  void count_skipped(std::string_view channel);
  bool stop_requested() const { return stop_requested_.load(); }

 private:
  using Decoder = std::function<void(std::span<const std::uint8_t>, ChannelStatistics&)>;

  template <class Message, class Handler>
  void subscribe_both(const Channel<Message>& channel, Handler handler, Delivery delivery);

  /// Counts a decoded message and what `seq` says was missed before it.
  void account(ChannelStatistics& statistics, std::int64_t seq);
  void add_decoder(std::string_view channel, Decoder decoder);

  BusStatistics statistics_;
  std::map<std::string, Decoder, std::less<>> decoders_;
  std::map<std::string, std::int64_t, std::less<>> next_seq_;
  std::vector<std::uint8_t> encode_buffer_;
  std::atomic<bool> stop_requested_{false};
};

template <class Message, class Handler>
void Bus::subscribe(const Channel<Message>& channel, Handler handler, Delivery delivery) {
  subscribe_both(
      channel,
      [handler = std::move(handler)](const Message& message,
                                     std::span<const std::uint8_t>) mutable { handler(message); },
      delivery);
}

template <class Message, class Handler>
void Bus::subscribe_undecoded(const Channel<Message>& channel, Handler handler, Delivery delivery) {
  subscribe_both(
      channel,
      [handler = std::move(handler)](const Message&, std::span<const std::uint8_t> bytes) mutable {
        handler(bytes);
      },
      delivery);
}

template <class Message, class Handler>
void Bus::subscribe_both(const Channel<Message>& channel, Handler handler, Delivery delivery) {
  add_decoder(channel.name,
              [this, handler = std::move(handler), message = std::make_shared<Message>()](
                  std::span<const std::uint8_t> bytes, ChannelStatistics& seen) mutable {
                const DecodeResult result = decode(bytes, *message);
                if (result != DecodeResult::kOk) {
                  ++seen.undecodable;
                  return;
                }
                account(seen, message->seq);
                handler(static_cast<const Message&>(*message), bytes);
              });
  subscribe_bytes(std::string(channel.name), delivery);
}

template <class Message>
void Bus::publish(const Channel<Message>& channel, Message& message) {
  const std::string name(channel.name);
  message.seq = ++next_seq_[name];
  encode(message, encode_buffer_);
  ++statistics_.channels[name].published;
  publish_bytes(name, encode_buffer_);
}

}  // namespace roomwise
