#pragma once
#include <functional>
#include <span>
#include <string>

#include "common/bus/bus.h"

namespace roomwise::viewer {

/// Turns what a page with the right to control sends into messages: five channels and no more. A
/// page's clock is not ours, so utime is the server's; source, priority and how long a drive
/// request lives are not the page's to choose either.
class ControlDesk {
 public:
  explicit ControlDesk(Bus& bus) : bus_(bus) {}

  /// Why `frame` is refused; empty: it will be published. May be called from any thread.
  std::string take(std::span<const std::uint8_t> frame);

 private:
  template <class Message>
  std::string take_message(const Channel<Message>& channel, std::span<const std::uint8_t> bytes);

  Bus& bus_;
};

}  // namespace roomwise::viewer
