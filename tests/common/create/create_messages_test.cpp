#include "common/create/create_messages.h"

#include <gtest/gtest.h>

#include <numbers>

namespace roomwise::create {
namespace {

constexpr Time kTime = time_from_utime(1'700'000'000'000'000);

create_state_t message_of(Model model, Packet packet, int value) {
  SensorPackets packets;
  packets.set(packet, value);
  return to_message(kTime, model, packets, OiMode::kSafe);
}

TEST(CreateMessages, BitsGoToTheSideTheyBelongTo) {
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kBumpsAndDrops, 1).bump_right, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kBumpsAndDrops, 2).bump_left, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kBumpsAndDrops, 4).drop_right, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kBumpsAndDrops, 8).drop_left, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kOvercurrents, 8).overcurrent_right_wheel, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kOvercurrents, 16).overcurrent_left_wheel, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kBumpsAndDrops, 2).bump_right, 0);
}

TEST(CreateMessages, OnlyCreateOneHasACasterSwitch) {
  EXPECT_EQ(message_of(Model::kCreate1, Packet::kBumpsAndDrops, 16).drop_caster, 1);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kBumpsAndDrops, 16).drop_caster, 0);
}

TEST(CreateMessages, NoInfraredIsZeroFromBothModels) {
  EXPECT_EQ(message_of(Model::kCreate1, Packet::kInfraredOmni, 255).infrared_omni, 0);
  EXPECT_EQ(message_of(Model::kCreate2, Packet::kInfraredOmni, 0).infrared_omni, 0);
  EXPECT_EQ(message_of(Model::kCreate1, Packet::kInfraredOmni, 248).infrared_omni, 248);
}

TEST(CreateMessages, UnitsAreSi) {
  EXPECT_DOUBLE_EQ(message_of(Model::kCreate2, Packet::kVoltage_mv, 14500).battery_v, 14.5);
  EXPECT_DOUBLE_EQ(message_of(Model::kCreate2, Packet::kCurrent_ma, -250).battery_a, -0.25);
  EXPECT_DOUBLE_EQ(message_of(Model::kCreate2, Packet::kTemperature_c, -3).battery_c, -3.0);
  EXPECT_DOUBLE_EQ(message_of(Model::kCreate1, Packet::kAngle_deg, -90).turned_rad,
                   -std::numbers::pi / 2.0);
  EXPECT_DOUBLE_EQ(
      message_of(Model::kCreate2, Packet::kRequestedLeft_mmps, -500).requested_left_mps, -0.5);
}

TEST(CreateMessages, ModeIsGivenAsUnderstoodAndAsSent) {
  SensorPackets packets;
  packets.set(Packet::kOiMode, 3);
  const create_state_t message = to_message(kTime, Model::kCreate2, packets, OiMode::kSafe);
  EXPECT_EQ(message.mode, create_state_t::MODE_SAFE);
  EXPECT_EQ(message.mode_byte, 3);
  EXPECT_EQ(message.utime, utime_of(kTime));
}

TEST(CreateMessages, OdometryIsCarriedWhole) {
  OdometryStep step;
  step.time = kTime;
  step.interval = std::chrono::milliseconds(15);
  step.reset_counter = 3;
  step.source = OdometrySource::kBody;
  step.distance_m = 0.1;
  step.turn_rad = -0.2;
  step.covariance << 1.0, 2.0, 2.0, 5.0;
  step.T_odom_robot = {1.0, 2.0, 3.0};
  const odometry_t message = to_message(step);
  EXPECT_EQ(message.interval_us, 15'000);
  EXPECT_EQ(message.reset_counter, 3);
  EXPECT_EQ(message.source, odometry_t::SOURCE_BODY);
  EXPECT_EQ(message.distance_increment_m, 0.1);
  EXPECT_EQ(message.turn_increment_rad, -0.2);
  EXPECT_EQ(message.covariance_distance_turn_m_rad, 2.0);
  EXPECT_EQ(message.covariance_turn_turn_rad2, 5.0);
  EXPECT_EQ(message.heading_rad, 3.0);
}

}  // namespace
}  // namespace roomwise::create
