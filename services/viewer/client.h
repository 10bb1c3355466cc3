#pragma once
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>

#include "services/viewer/core/access.h"
#include "services/viewer/core/client_queue.h"
#include "services/viewer/replay/replay_desk.h"

namespace roomwise::viewer {

/// One page. Whatever goes to it goes from its own thread, so that a page that does not read delays
/// nobody else. While it looks at a log it gets nothing that is live.
class Client {
 public:
  /// Sends one WebSocket frame; false if the page is gone. May block.
  using Send = std::function<bool(bool is_text, std::span<const char> bytes)>;

  Client(Rights rights, std::filesystem::path logs, Send send);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client();

  Rights rights() const { return rights_; }

  /// Any thread; returns at once.
  void push(const SharedPacket& packet);
  void order(std::string text);

 private:
  using Clock = ReplayDesk::Clock;

  void run();
  void wait(std::unique_lock<std::mutex>& lock);
  void follow_orders(std::unique_lock<std::mutex>& lock);
  bool send_next(std::unique_lock<std::mutex>& lock);
  bool send_status_if_due(std::int64_t dropped);
  void send_packet(const Packet& packet);

  Rights rights_;
  std::filesystem::path logs_;
  Send send_;
  ReplayDesk replay_;
  bool gone_ = false;
  std::string refusal_;
  Clock::time_point status_due_ = Clock::now();

  std::mutex mutex_;
  std::condition_variable wake_;
  ClientQueue queue_;
  std::deque<std::string> orders_;
  bool live_ = true;
  bool stop_ = false;
  std::thread sender_;
};

}  // namespace roomwise::viewer
