#include "services/viewer/control_desk.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/bus/wire.h"
#include "services/viewer/core/packet_format.h"

namespace roomwise::viewer {
namespace {

/// A drive request that is not repeated dies this soon: the dead man's hand.
constexpr std::int64_t kDriveValid_us = 300'000;

void settle(velocity_request_t& message) {
  message.source = "viewer";
  message.priority = velocity_request_t::PRIORITY_PERSON;
  message.valid_for_us = std::clamp<std::int64_t>(message.valid_for_us, 0, kDriveValid_us);
}
void settle(estop_t& message) { message.source = "viewer"; }
void settle(safety_reset_t& message) { message.source = "viewer"; }
void settle(pilot_goal_t& message) { message.source = "viewer"; }
void settle(segment_training_t&) {}

/// A text with a zero inside cannot be encoded, and would end the bus's thread.
template <class Message>
bool can_be_sent(const Message& message) {
  std::vector<std::uint8_t> bytes;
  try {
    encode(message, bytes);
  } catch (const std::logic_error&) {
    return false;
  }
  return true;
}

}  // namespace

template <class Message>
std::string ControlDesk::take_message(const Channel<Message>& channel,
                                      std::span<const std::uint8_t> bytes) {
  Message message;
  if (decode(bytes, message) != DecodeResult::kOk) return "not a whole message of its channel";
  settle(message);
  if (!can_be_sent(message)) return "a text with a zero inside";
  bus_.post([this, channel, message = std::move(message)]() mutable {
    message.utime = utime_of(bus_.now());
    bus_.publish(channel, message);
  });
  return {};
}

std::string ControlDesk::take(std::span<const std::uint8_t> frame) {
  const auto command = parse_command(frame);
  if (!command) return "too long, or no channel and message";
  const auto [name, bytes] = *command;
  if (name == channels::kVelRequest.name) return take_message(channels::kVelRequest, bytes);
  if (name == channels::kEstop.name) return take_message(channels::kEstop, bytes);
  if (name == channels::kSafetyReset.name) return take_message(channels::kSafetyReset, bytes);
  if (name == channels::kPilotGoal.name) return take_message(channels::kPilotGoal, bytes);
  if (name == channels::kSegmentTrain.name) return take_message(channels::kSegmentTrain, bytes);
  return "a channel no page may publish on";
}

}  // namespace roomwise::viewer
