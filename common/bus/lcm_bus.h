#pragma once
#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <mutex>
#include <string>
#include <vector>

#include "common/bus/bus.h"
#include "common/bus/log_event.h"

namespace roomwise {

/// The live Bus: LCM over UDP multicast. The only place that asks the wall clock.
///
/// run() first empties LCM's queues into an inbox in order of arrival (for kLatest channels only
/// the newest stays), then handles the inbox: LCM 1.3.1 by itself keeps the oldest and drops the
/// newest.
class LcmBus : public Bus {
 public:
  /// Throws std::runtime_error naming the URL if LCM cannot be opened on it.
  explicit LcmBus(const std::string& url);
  ~LcmBus() override;

  void every(Duration period, Tick tick) override;
  void post(std::function<void()> work) override;
  Time now() const override;
  void run() override;
  bool is_replay() const override { return false; }

 protected:
  void subscribe_bytes(const std::string& channel, Delivery delivery) override;
  void publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) override;

 private:
  struct Periodic {
    Duration period;
    Tick tick;
    Time next;
  };
  void on_message(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void wait_for_message();
  void fill_inbox();
  void empty_inbox();
  void do_posted_work();
  void fire_due_ticks();

  std::string url_;
  lcm::LCM lcm_;
  std::map<std::string, Delivery, std::less<>> deliveries_;
  std::deque<LogEvent> inbox_;
  std::vector<LogEvent> spare_;  ///< handled events whose memory is used again
  std::vector<Periodic> periodics_;
  int post_event_;  ///< readable while there is posted work
  std::mutex posted_mutex_;
  std::vector<std::function<void()>> posted_;
};

}  // namespace roomwise
