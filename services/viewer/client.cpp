#include "services/viewer/client.h"

#include <fmt/format.h>

#include <utility>

#include "services/viewer/core/packet_format.h"

namespace roomwise::viewer {
namespace {

constexpr std::chrono::milliseconds kStatusPeriod{250};
constexpr std::chrono::milliseconds kReplayTick{10};
/// A page that orders more than that without waiting is not ours.
constexpr std::size_t kMostOrders = 100;

std::string json_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + json_text(name);
  return "[" + list + "]";
}

}  // namespace

Client::Client(Rights rights, std::filesystem::path logs, Send send)
    : rights_(rights),
      logs_(std::move(logs)),
      send_(std::move(send)),
      replay_(logs_,
              [this](const LogEvent& event) {
                send_packet(*make_packet(event.channel, utime_of(event.time), event.data));
              }),
      sender_([this] { run(); }) {}

Client::~Client() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  sender_.join();
}

void Client::push(const SharedPacket& packet) {
  {
    const std::lock_guard lock(mutex_);
    if (!live_) return;
    queue_.push(packet);
  }
  wake_.notify_one();
}

void Client::order(std::string text) {
  {
    const std::lock_guard lock(mutex_);
    if (orders_.size() < kMostOrders) orders_.push_back(std::move(text));
  }
  wake_.notify_one();
}

void Client::run() {
  std::unique_lock lock(mutex_);
  while (!stop_ && !gone_) {
    wait(lock);
    follow_orders(lock);
    const std::int64_t dropped = queue_.dropped();
    lock.unlock();
    replay_.play(Clock::now());
    if (!send_status_if_due(dropped)) gone_ = true;
    lock.lock();
    while (!stop_ && !gone_ && orders_.empty() && send_next(lock)) {
    }
  }
}

void Client::wait(std::unique_lock<std::mutex>& lock) {
  const auto until = replay_.is_playing() ? Clock::now() + kReplayTick : status_due_;
  wake_.wait_until(lock, until, [this] { return stop_ || !orders_.empty() || !queue_.empty(); });
}

void Client::follow_orders(std::unique_lock<std::mutex>& lock) {
  while (!orders_.empty() && !stop_) {
    const std::string order = std::move(orders_.front());
    orders_.pop_front();
    if (order.starts_with("open ")) live_ = false;
    queue_.clear();
    lock.unlock();
    refusal_ = replay_.follow(order, Clock::now());
    status_due_ = Clock::now();
    lock.lock();
    live_ = !replay_.is_replay();
  }
}

bool Client::send_next(std::unique_lock<std::mutex>& lock) {
  const SharedPacket packet = queue_.pop();
  if (!packet) return false;
  lock.unlock();
  send_packet(*packet);
  lock.lock();
  return Clock::now() < status_due_;
}

void Client::send_packet(const Packet& packet) {
  if (gone_) return;
  gone_ = !send_(false, {reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size()});
}

bool Client::send_status_if_due(std::int64_t dropped) {
  if (Clock::now() < status_due_) return true;
  status_due_ = Clock::now() + kStatusPeriod;
  const std::string text = fmt::format(R"({{{},"control":{},"dropped":{},"refusal":{},"logs":{}}})",
                                       replay_.status(), rights_ == Rights::kControl, dropped,
                                       json_text(refusal_), json_list(log_names(logs_)));
  return send_(true, text);
}

}  // namespace roomwise::viewer
