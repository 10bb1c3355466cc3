#include "services/viewer/core/packet_format.h"

#include <string>

namespace roomwise::viewer {

SharedPacket make_packet(std::string_view channel, std::int64_t utime,
                         std::span<const std::uint8_t> message) {
  auto packet = std::make_shared<Packet>();
  packet->channel = channel;
  auto& bytes = packet->bytes;
  bytes.reserve(1 + channel.size() + sizeof utime + message.size());
  bytes.push_back(static_cast<std::uint8_t>(channel.size()));
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  for (int shift = 56; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(utime) >> shift));
  }
  bytes.insert(bytes.end(), message.begin(), message.end());
  return packet;
}

std::optional<Command> parse_command(std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || bytes.size() > kLongestCommand_bytes) return {};
  const std::size_t length = bytes[0];
  if (length == 0 || bytes.size() < 1 + length + 8) return {};
  const auto* name = reinterpret_cast<const char*>(bytes.data() + 1);
  return Command{{name, length}, bytes.subspan(1 + length)};
}

}  // namespace roomwise::viewer
