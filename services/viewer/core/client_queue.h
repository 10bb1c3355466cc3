#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace roomwise::viewer {

/// What goes to a page in one WebSocket frame; several clients share it.
struct Packet {
  std::string channel;
  std::vector<std::uint8_t> bytes;
};
using SharedPacket = std::shared_ptr<const Packet>;

/// What waits for one client: the newest packet of each channel, in order of arrival. It never
/// holds more packets than there are channels.
class ClientQueue {
 public:
  /// Takes the place of an older packet of the same channel, which is counted as dropped.
  void push(SharedPacket packet);

  /// The one that waits longest; null if none does.
  SharedPacket pop();

  void clear() { waiting_.clear(); }
  bool empty() const { return waiting_.empty(); }
  std::size_t size() const { return waiting_.size(); }
  std::int64_t dropped() const { return dropped_; }

 private:
  std::deque<SharedPacket> waiting_;
  std::int64_t dropped_ = 0;
};

}  // namespace roomwise::viewer
