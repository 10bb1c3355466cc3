// The whole service on a bus of vectors: what it says of a log.
#include "services/safety_svc/safety_service.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/bus/log_bus.h"
#include "tests/support/events.h"

namespace roomwise {
namespace {

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

kinect_frame_t frame(std::int64_t utime) {
  kinect_frame_t message{};
  message.utime = utime;
  message.depth_fy_px = 430.0;
  message.depth_cy_px = 240.0;
  message.depth_height_px = 480;
  message.T_robot_camera_translation_m[2] = 0.4;
  const double quat[4] = {0.5, -0.5, 0.5, -0.5};
  std::copy(std::begin(quat), std::end(quat), message.T_robot_camera_quat);
  return message;
}

segmentation_t segments(std::int64_t utime) {
  segmentation_t message{};
  message.utime = utime;
  message.bin_count = 91;
  message.bin_step_rad = M_PI / 180.0;
  message.bin_first_bearing_rad = -45.0 * message.bin_step_rad;
  message.free_range_m.assign(91, 3.0);
  message.unknown_ratio.assign(91, 0.0);
  message.obstacle_range_m.assign(91, 0.0);
  return message;
}

odometry_t odometry(std::int64_t utime) {
  odometry_t message{};
  message.utime = utime;
  message.interval_us = 20'000;
  return message;
}

create_state_t create_state(std::int64_t utime) {
  create_state_t message{};
  message.utime = utime;
  message.mode = create_state_t::MODE_SAFE;
  message.driver_state = create_state_t::DRIVER_DRIVING;
  return message;
}

velocity_request_t request(std::int64_t utime) {
  velocity_request_t message{};
  message.utime = utime;
  message.source = "test";
  message.valid_for_us = 100'000;
  message.requested_speed_mps = 0.3;
  return message;
}

/// Two seconds in which all is well and somebody asks for 0.3 m/s.
std::vector<LogEvent> good_log() {
  std::vector<LogEvent> log;
  for (std::int64_t i = 0; i < 100; ++i) {
    const std::int64_t utime = kStart_us + 20'000 * i + 3'000;
    log.push_back(event_of(channels::kKinectFrame, utime, frame(utime)));
    log.push_back(event_of(channels::kOdometry, utime, odometry(utime)));
    log.push_back(event_of(channels::kSegments, utime, segments(utime)));
    log.push_back(event_of(channels::kCreateState, utime, create_state(utime)));
    log.push_back(event_of(channels::kVelRequest, utime, request(utime)));
  }
  return log;
}

std::vector<LogEvent> output_of(const std::vector<LogEvent>& log) {
  std::vector<LogEvent> output;
  LogBus bus(log, output);
  const SafetyService service(bus, {});
  bus.run();
  return output;
}

template <class Message>
std::vector<Message> decoded(const Channel<Message>& channel, const std::vector<LogEvent>& events) {
  std::vector<Message> messages;
  for (const LogEvent& event : events) {
    if (event.channel != channel.name) continue;
    EXPECT_EQ(decode(event.data, messages.emplace_back()), DecodeResult::kOk);
  }
  return messages;
}

TEST(SafetyService, AllowsMotionWhenAllIsWell) {
  const auto commands = decoded(channels::kVelCmd, output_of(good_log()));
  ASSERT_GT(commands.size(), 95U);
  EXPECT_GT(commands.back().allowed_speed_mps, 0.09);
  EXPECT_EQ(commands.back().expiry_utime - commands.back().utime, 200'000);
}

TEST(SafetyService, AlwaysSpeaksAndSaysZeroWhenOnlyTimeGoesBy) {
  std::vector<LogEvent> log;
  for (std::int64_t i = 0; i < 50; ++i) {
    const std::int64_t utime = kStart_us + 20'000 * i;
    log.push_back(event_of(channels::kVelRequest, utime, request(utime)));
  }
  const auto output = output_of(log);
  const auto commands = decoded(channels::kVelCmd, output);
  ASSERT_GT(commands.size(), 45U);
  for (const velocity_command_t& command : commands) {
    EXPECT_EQ(command.allowed_speed_mps, 0.0);
    EXPECT_EQ(command.reason, velocity_command_t::REASON_NO_CAMERA);
  }
  const auto states = decoded(channels::kSafetyState, output);
  ASSERT_GE(states.size(), 9U);
  EXPECT_EQ(states.back().state, safety_state_t::STATE_STOP);
  EXPECT_EQ(states.back().segments_age_s, -1.0);
  EXPECT_EQ(states.back().request_source, "test");
}

TEST(SafetyService, TheSameLogGivesTheSameBytesAndNoSignature) {
  const auto log = good_log();
  const auto first = output_of(log);
  const auto second = output_of(log);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].data, second[i].data);
  for (const auto& command : decoded(channels::kVelCmd, first)) {
    EXPECT_EQ(command.signature_size, 0);
  }
}

TEST(SafetyService, ABumpIsAnsweredWithoutWaitingForATick) {
  auto log = good_log();
  const std::int64_t utime = kStart_us + 2'000'000 + 4'000;
  create_state_t bumped = create_state(utime);
  bumped.bump_left = 1;
  log.push_back(event_of(channels::kCreateState, utime, bumped));
  const auto commands = decoded(channels::kVelCmd, output_of(log));
  EXPECT_EQ(commands.back().utime, utime);
  EXPECT_EQ(commands.back().allowed_speed_mps, 0.0);
  EXPECT_EQ(commands.back().reason, velocity_command_t::REASON_BUMP);
}

TEST(SafetyService, AnEmptyViewAfterAFullOneIsNoView) {
  auto log = good_log();
  for (std::int64_t i = 0; i < 20; ++i) {
    const std::int64_t utime = kStart_us + 2'000'000 + 20'000 * i + 3'000;
    segmentation_t empty{};
    empty.utime = utime;
    log.push_back(event_of(channels::kKinectFrame, utime, frame(utime)));
    log.push_back(event_of(channels::kOdometry, utime, odometry(utime)));
    log.push_back(event_of(channels::kSegments, utime, empty));
    log.push_back(event_of(channels::kCreateState, utime, create_state(utime)));
    log.push_back(event_of(channels::kVelRequest, utime, request(utime)));
  }
  const auto commands = decoded(channels::kVelCmd, output_of(log));
  EXPECT_EQ(commands.back().reason, velocity_command_t::REASON_NO_CAMERA);
}

}  // namespace
}  // namespace roomwise
