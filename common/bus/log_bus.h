#pragma once
#include <functional>
#include <string>
#include <vector>

#include "common/bus/bus.h"
#include "common/bus/log_event.h"

namespace roomwise {

/// A Bus whose world is a sequence of recorded events: offline replay and unit tests. The same
/// events give the same calls and the same published bytes, always. Time is the events' time.
class LogBus : public Bus {
 public:
  /// Puts the next event into its argument; false when there are no more.
  using Source = std::function<bool(LogEvent&)>;
  /// Takes what the process publishes, stamped with the time of the event being handled.
  using Sink = std::function<void(const LogEvent&)>;
  /// Sees every input event before it is handled.
  using Tap = std::function<void(const LogEvent&)>;

  LogBus(Source source, Sink sink, Tap tap = {});

  /// Reads from a vector (which must outlive the bus) and collects what is published into another.
  LogBus(const std::vector<LogEvent>& input, std::vector<LogEvent>& output);

  void every(Duration period, Tick tick) override;
  void post(std::function<void()> work) override;
  Time now() const override { return now_; }
  void run() override;
  bool is_replay() const override { return true; }

  /// False if stop() ended run() before the log did.
  bool reached_end() const { return reached_end_; }

 protected:
  void subscribe_bytes(const std::string& channel, Delivery delivery) override;
  void publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) override;

 private:
  struct Periodic {
    Duration period;
    Tick tick;
    Time next{};
    bool started = false;
  };
  void fire_ticks_until(Time time);

  Source source_;
  Sink sink_;
  Tap tap_;
  Time now_{};
  bool reached_end_ = false;
  LogEvent out_;
  std::vector<Periodic> periodics_;
};

}  // namespace roomwise
