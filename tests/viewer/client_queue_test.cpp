#include "services/viewer/core/client_queue.h"

#include <gtest/gtest.h>

#include <vector>

#include "services/viewer/core/packet_format.h"

namespace roomwise::viewer {
namespace {

SharedPacket packet(std::string_view channel, std::uint8_t content) {
  return make_packet(channel, 0, std::vector<std::uint8_t>{content});
}

TEST(ClientQueue, KeepsTheNewestOfEachChannelAndCountsTheRest) {
  ClientQueue queue;
  for (std::uint8_t i = 0; i < 100; ++i) {
    queue.push(packet("POSE", i));
    queue.push(packet("HEALTH", i));
  }
  EXPECT_EQ(queue.size(), 2U);
  EXPECT_EQ(queue.dropped(), 198);
  EXPECT_EQ(queue.pop()->bytes.back(), 99);
  EXPECT_EQ(queue.pop()->bytes.back(), 99);
  EXPECT_EQ(queue.pop(), nullptr);
}

TEST(ClientQueue, AFastChannelDoesNotStarveAnother) {
  ClientQueue queue;
  queue.push(packet("FAST", 0));
  queue.push(packet("SLOW", 0));
  queue.push(packet("FAST", 1));
  EXPECT_EQ(queue.pop()->channel, "FAST");
  queue.push(packet("FAST", 2));
  EXPECT_EQ(queue.pop()->channel, "SLOW");
}

TEST(PacketFormat, HoldsChannelTimeAndMessage) {
  const auto made = make_packet("AB", 0x0102030405060708, std::vector<std::uint8_t>{9});
  EXPECT_EQ(made->bytes, (std::vector<std::uint8_t>{2, 'A', 'B', 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(CommandFormat, ShortLongOrNamelessFramesAreRefused) {
  EXPECT_FALSE(parse_command({}));
  for (std::size_t size : {std::size_t{1}, std::size_t{8}, kLongestCommand_bytes + 1}) {
    EXPECT_FALSE(parse_command(std::vector<std::uint8_t>(size, 1))) << size;
  }
  EXPECT_FALSE(parse_command(std::vector<std::uint8_t>(20, 0)));
  EXPECT_FALSE(parse_command(std::vector<std::uint8_t>(20, 255)));
}

}  // namespace
}  // namespace roomwise::viewer
