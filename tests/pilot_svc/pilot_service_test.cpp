#include "services/pilot_svc/pilot_service.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/bus/log_bus.h"
#include "common/bus/wire.h"

namespace roomwise {
namespace {

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class PilotServiceTest : public testing::Test {
 protected:
  template <class Message>
  void send(const Channel<Message>& channel, const Message& message) {
    const Time when{Duration(static_cast<std::int64_t>(input_.size()))};
    LogEvent event{when, std::string(channel.name), {}};
    encode(message, event.data);
    input_.push_back(std::move(event));
  }
  void send_goal(std::int8_t behaviour) {
    pilot_goal_t goal{};
    goal.utime = kStart_us;
    goal.behaviour = behaviour;
    goal.circle_distance_m = 0.5;
    goal.circle_sense = 1;
    goal.circle_rounds_ratio = 1.0;
    send(channels::kPilotGoal, goal);
  }
  void send_odometry(std::int64_t ms, double x_m = 0.0) {
    odometry_t message{};
    message.utime = kStart_us + 1000 * ms;
    message.x_m = x_m;
    send(channels::kOdometry, message);
  }
  void send_segments(std::int64_t ms, double free_m = 2.5) {
    segmentation_t message{};
    message.utime = kStart_us + 1000 * ms;
    message.bin_count = 41;
    message.bin_first_bearing_rad = -0.4;
    message.bin_step_rad = 0.02;
    message.free_range_m.assign(41, free_m);
    message.unknown_ratio.assign(41, 0.0);
    message.obstacle_range_m.assign(41, 0.0);
    send(channels::kSegments, message);
  }
  void send_second_of_both(std::int64_t from_ms) {
    for (std::int64_t ms = from_ms; ms < from_ms + 1000; ms += 20) {
      send_odometry(ms);
      if (ms % 40 == 0) send_segments(ms);
    }
  }
  std::vector<LogEvent> run() {
    std::vector<LogEvent> output;
    LogBus bus(input_, output);
    PilotService service(bus, {});
    bus.run();
    counters_ = bus.statistics().counters;
    return output;
  }
  template <class Message>
  static std::vector<Message> all(const Channel<Message>& channel,
                                  const std::vector<LogEvent>& events) {
    std::vector<Message> messages;
    for (const LogEvent& event : events) {
      if (event.channel != channel.name) continue;
      messages.emplace_back();
      if (decode(event.data, messages.back()) != DecodeResult::kOk)
        throw std::logic_error("decode");
    }
    return messages;
  }

  std::vector<LogEvent> input_;
  std::map<std::string, std::int64_t, std::less<>> counters_;
};

TEST_F(PilotServiceTest, AsksForNothingWithoutAGoal) {
  send_second_of_both(0);
  const auto output = run();
  EXPECT_TRUE(all(channels::kVelRequest, output).empty());
  EXPECT_EQ(all(channels::kPilotState, output).back().state, pilot_state_t::STATE_IDLE);
}

TEST_F(PilotServiceTest, WandersAtTwentyRequestsASecondThatSoonDie) {
  send_goal(pilot_goal_t::BEHAVIOUR_WANDER);
  send_second_of_both(0);
  const auto output = run();
  const auto requests = all(channels::kVelRequest, output);
  EXPECT_NEAR(static_cast<double>(requests.size()), 20.0, 2.0);
  EXPECT_GT(requests.back().requested_speed_mps, 0.1);
  EXPECT_EQ(requests.back().valid_for_us, 200'000);
  EXPECT_EQ(requests.back().source, "pilot_svc");
  const auto states = all(channels::kPilotState, output);
  EXPECT_EQ(states.back().state, pilot_state_t::STATE_DRIVING);
  EXPECT_EQ(states.back().goal_utime, kStart_us);
  EXPECT_GE(states.size(), 5U);
}

TEST_F(PilotServiceTest, SaysWhatItWaitsForAndAsksForZero) {
  send_goal(pilot_goal_t::BEHAVIOUR_GO_TO);
  send_second_of_both(0);
  const auto output = run();
  for (const auto& request : all(channels::kVelRequest, output)) {
    EXPECT_EQ(request.requested_speed_mps, 0.0);
    EXPECT_EQ(request.requested_turn_rate_radps, 0.0);
  }
  EXPECT_EQ(all(channels::kPilotState, output).back().state, pilot_state_t::STATE_WAITING);
  EXPECT_EQ(all(channels::kPilotState, output).back().explanation, "waits for POSE");
}

TEST_F(PilotServiceTest, SegmentsAloneTellThatOdometryFellSilent) {
  send_goal(pilot_goal_t::BEHAVIOUR_WANDER);
  send_second_of_both(0);
  for (std::int64_t ms = 1000; ms < 2500; ms += 40) send_segments(ms);
  const auto output = run();
  EXPECT_EQ(all(channels::kVelRequest, output).back().requested_speed_mps, 0.0);
  EXPECT_EQ(all(channels::kPilotState, output).back().explanation, "waits for ODOMETRY");
}

TEST_F(PilotServiceTest, AnEmergencyStopIsWaitedForAndABumpIsBackedOffFrom) {
  send_goal(pilot_goal_t::BEHAVIOUR_WANDER);
  send_second_of_both(0);
  safety_state_t safety{};
  safety.state = safety_state_t::STATE_STOP;
  safety.reason_count = 1;
  safety.reasons = {velocity_command_t::REASON_BUMP};
  send(channels::kSafetyState, safety);
  send_second_of_both(1000);
  EXPECT_LT(all(channels::kVelRequest, run()).back().requested_speed_mps, 0.0);
  safety.state = safety_state_t::STATE_ESTOP;
  send(channels::kSafetyState, safety);
  send_second_of_both(2000);
  const auto output = run();
  EXPECT_EQ(all(channels::kVelRequest, output).back().requested_speed_mps, 0.0);
  EXPECT_EQ(all(channels::kPilotState, output).back().explanation, "safety_svc holds it");
}

TEST_F(PilotServiceTest, AnUnknownBehaviourIsABadGoal) {
  send_goal(77);
  const auto states = all(channels::kPilotState, run());
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].failure, pilot_state_t::FAILURE_BAD_GOAL);
}

TEST_F(PilotServiceTest, HostileMessagesAreCountedAndStopNothing) {
  send_goal(pilot_goal_t::BEHAVIOUR_WANDER);
  send_second_of_both(0);
  send_odometry(1000, kNaN);
  send_odometry(std::numeric_limits<std::int64_t>::max() / 2000 - kStart_us / 1000);
  send_segments(std::numeric_limits<std::int64_t>::min() / 2000);
  send_segments(980, kNaN);
  send_segments(981, 1e300);
  send_segments(982, -1e300);
  pose_t pose{};
  pose.utime = -5;
  send(channels::kPose, pose);
  pose.utime = kStart_us + 980'000;
  pose.heading_rad = kNaN;
  send(channels::kPose, pose);
  const auto output = run();
  for (const auto& request : all(channels::kVelRequest, output)) {
    EXPECT_LE(std::abs(request.requested_speed_mps), 0.5);
    EXPECT_LE(std::abs(request.requested_turn_rate_radps), 3.0);
  }
  EXPECT_EQ(counters_["odometry_not_finite"], 1);
  EXPECT_EQ(counters_["odometry_time_invalid"], 1);
  EXPECT_EQ(counters_["segments_time_invalid"], 1);
  EXPECT_EQ(counters_["pose_time_invalid"], 1);
  EXPECT_EQ(counters_["pose_not_finite"], 1);
}

TEST_F(PilotServiceTest, TheSameMessagesGiveTheSameBytes) {
  send_goal(pilot_goal_t::BEHAVIOUR_WANDER);
  send_second_of_both(0);
  const auto first = run();
  const auto second = run();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].data, second[i].data);
}

}  // namespace
}  // namespace roomwise
