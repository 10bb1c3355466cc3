#include "common/bus/lcm_bus.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>

namespace roomwise {
namespace {

/// A handler may run this many small messages late before LCM drops any.
constexpr int kQueueCapacity = 1000;
/// Frames are large, and only the newest counts: enough for a third of a second at 30 Hz.
constexpr int kLatestQueueCapacity = 10;
/// However busy the bus, handlers get their turn after this many messages.
constexpr int kMostPerRound = 2000;
/// How soon stop() is seen when nothing arrives.
constexpr Duration kLongestWait{50'000};

}  // namespace

LcmBus::LcmBus(const std::string& url)
    : url_(url), lcm_(url), post_event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (post_event_ < 0) throw std::runtime_error("no eventfd for posted work");
  if (!lcm_.good()) {
    throw std::runtime_error("cannot open LCM on " + url +
                             " (is there a multicast route? ip route add 224.0.0.0/4 dev lo)");
  }
}

LcmBus::~LcmBus() { ::close(post_event_); }

void LcmBus::every(Duration period, Tick tick) {
  periodics_.push_back({period, std::move(tick), next_multiple(now(), period)});
}

Time LcmBus::now() const {
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

void LcmBus::run() {
  while (!stop_requested()) {
    wait_for_message();
    fill_inbox();
    empty_inbox();
    do_posted_work();
    fire_due_ticks();
  }
}

void LcmBus::wait_for_message() {
  Duration wait = kLongestWait;
  for (const Periodic& periodic : periodics_) wait = std::min(wait, periodic.next - now());
  const auto wait_ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(wait, Duration{0}));
  std::array<pollfd, 2> readable{{{.fd = lcm_.getFileno(), .events = POLLIN, .revents = 0},
                                  {.fd = post_event_, .events = POLLIN, .revents = 0}}};
  // A signal ends it early, as it should.
  ::poll(readable.data(), readable.size(), static_cast<int>(wait_ms.count()));
}

void LcmBus::post(std::function<void()> work) {
  {
    const std::lock_guard lock(posted_mutex_);
    posted_.push_back(std::move(work));
  }
  ::eventfd_write(post_event_, 1);
}

void LcmBus::do_posted_work() {
  eventfd_t posts = 0;
  ::eventfd_read(post_event_, &posts);
  std::vector<std::function<void()>> posted;
  {
    const std::lock_guard lock(posted_mutex_);
    posted.swap(posted_);
  }
  for (const auto& work : posted) work();
}

void LcmBus::fill_inbox() {
  for (int i = 0; i < kMostPerRound; ++i) {
    const int handled = lcm_.handleTimeout(0);
    if (handled > 0) continue;
    if (handled < 0 && !stop_requested() && errno != EINTR) {
      throw std::runtime_error("LCM failed on " + url_);
    }
    return;
  }
}

void LcmBus::empty_inbox() {
  while (!inbox_.empty() && !stop_requested()) {
    LogEvent event = std::move(inbox_.front());
    inbox_.pop_front();
    deliver(event.channel, event.data);
    spare_.push_back(std::move(event));
  }
}

void LcmBus::fire_due_ticks() {
  for (Periodic& periodic : periodics_) {
    const Time time = now();
    const bool clock_went_back = periodic.next - time > 2 * periodic.period;
    if (time < periodic.next && !clock_went_back) continue;
    const Time nominal = next_multiple(time, periodic.period) - periodic.period;
    periodic.next = nominal + periodic.period;
    periodic.tick(nominal);
  }
}

void LcmBus::subscribe_bytes(const std::string& channel, Delivery delivery) {
  // LCM takes a regular expression; ours are plain names, matched whole.
  lcm::Subscription* subscription = lcm_.subscribe(channel, &LcmBus::on_message, this);
  if (subscription == nullptr) throw std::runtime_error("cannot subscribe to " + channel);
  subscription->setQueueCapacity(delivery == Delivery::kLatest ? kLatestQueueCapacity
                                                               : kQueueCapacity);
  deliveries_[channel] = delivery;
}

void LcmBus::on_message(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  // LCM's C frames lie between here and run(): nothing in here may throw but for want of memory.
  if (deliveries_.find(channel)->second == Delivery::kLatest) {
    const auto older = std::find_if(inbox_.begin(), inbox_.end(),
                                    [&](const LogEvent& e) { return e.channel == channel; });
    if (older != inbox_.end()) {
      count_skipped(channel);
      spare_.push_back(std::move(*older));
      inbox_.erase(older);
    }
  }
  LogEvent event;
  if (!spare_.empty()) {
    event = std::move(spare_.back());
    spare_.pop_back();
  }
  const auto* bytes = static_cast<const std::uint8_t*>(buffer->data);
  event.time = time_from_utime(buffer->recv_utime);
  event.channel = channel;
  event.data.assign(bytes, bytes + buffer->data_size);
  inbox_.push_back(std::move(event));
}

void LcmBus::publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) {
  if (lcm_.publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size())) != 0) {
    count("publish_failed");
  }
}

}  // namespace roomwise
