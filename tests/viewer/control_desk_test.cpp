#include "services/viewer/control_desk.h"

#include <gtest/gtest.h>

#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "common/bus/wire.h"

namespace roomwise::viewer {
namespace {

/// Does posted work at once, and remembers what was published.
class RememberingBus : public Bus {
 public:
  std::vector<std::pair<std::string, std::vector<std::uint8_t>>> published;

  void every(Duration, Tick) override {}
  void post(std::function<void()> work) override { work(); }
  Time now() const override { return time_from_utime(77); }
  void run() override {}
  bool is_replay() const override { return false; }

 protected:
  void subscribe_bytes(const std::string&, Delivery) override {}
  void publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) override {
    published.emplace_back(channel, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  }
};

template <class Message>
std::vector<std::uint8_t> frame_of(std::string_view channel, const Message& message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(channel.size())};
  frame.insert(frame.end(), channel.begin(), channel.end());
  frame.insert(frame.end(), bytes.begin(), bytes.end());
  return frame;
}

TEST(ControlDesk, ADriveRequestDiesSoonAndIsAPersons) {
  RememberingBus bus;
  velocity_request_t request{};
  request.source = "pilot_svc";
  request.priority = 100;
  request.valid_for_us = 3'600'000'000;
  EXPECT_EQ(ControlDesk(bus).take(frame_of("VEL_REQUEST", request)), "");
  ASSERT_EQ(bus.published.size(), 1U);
  velocity_request_t sent;
  ASSERT_EQ(decode(bus.published[0].second, sent), DecodeResult::kOk);
  EXPECT_EQ(sent.source, "viewer");
  EXPECT_EQ(sent.priority, velocity_request_t::PRIORITY_PERSON);
  EXPECT_LE(sent.valid_for_us, 300'000);
  EXPECT_EQ(sent.utime, 77);
}

TEST(ControlDesk, PublishesOnNoOtherChannel) {
  RememberingBus bus;
  ControlDesk desk(bus);
  EXPECT_NE(desk.take(frame_of("VEL_CMD", velocity_command_t{})), "");
  EXPECT_NE(desk.take(frame_of("POSE", pose_t{})), "");
  EXPECT_NE(desk.take(frame_of("VEL_REQUEST", pose_t{})), "");
  EXPECT_TRUE(bus.published.empty());
}

TEST(ControlDesk, FramesCutShortAreRefused) {
  RememberingBus bus;
  const auto frame = frame_of("ESTOP", estop_t{});
  for (std::size_t size = 0; size < frame.size(); ++size) {
    EXPECT_NE(ControlDesk(bus).take(std::span(frame).first(size)), "") << size;
  }
  EXPECT_TRUE(bus.published.empty());
}

TEST(ControlDesk, ATextWithAZeroInsideIsRefused) {
  RememberingBus bus;
  estop_t message{};
  message.cause = "XYZ";
  auto frame = frame_of("ESTOP", message);
  frame[frame.size() - 3] = 0;
  EXPECT_NE(ControlDesk(bus).take(frame), "");
  EXPECT_TRUE(bus.published.empty());
}

}  // namespace
}  // namespace roomwise::viewer
