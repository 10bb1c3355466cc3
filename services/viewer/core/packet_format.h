#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "services/viewer/core/client_queue.h"

/// A binary WebSocket frame: u8 length of the channel's name, the name, then
///   to the page:   int64 time [us since the epoch, big-endian] and the LCM message;
///   from the page: the LCM message.
namespace roomwise::viewer {

/// No message a page sends is near that long.
constexpr std::size_t kLongestCommand_bytes = 4096;

SharedPacket make_packet(std::string_view channel, std::int64_t utime,
                         std::span<const std::uint8_t> message);

struct Command {
  std::string_view channel;
  std::span<const std::uint8_t> message;
};

/// Views into `bytes`; nothing if they are too long, or no channel and message.
std::optional<Command> parse_command(std::span<const std::uint8_t> bytes);

}  // namespace roomwise::viewer
