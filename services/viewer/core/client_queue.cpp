#include "services/viewer/core/client_queue.h"

#include <algorithm>
#include <utility>

namespace roomwise::viewer {

void ClientQueue::push(SharedPacket packet) {
  const auto older = std::ranges::find_if(
      waiting_, [&](const SharedPacket& p) { return p->channel == packet->channel; });
  if (older == waiting_.end()) {
    waiting_.push_back(std::move(packet));
    return;
  }
  *older = std::move(packet);  // keeps its turn: a fast channel cannot starve itself
  ++dropped_;
}

SharedPacket ClientQueue::pop() {
  if (waiting_.empty()) return nullptr;
  SharedPacket first = std::move(waiting_.front());
  waiting_.pop_front();
  return first;
}

}  // namespace roomwise::viewer
