#include "common/create/create_messages.h"

#include <numbers>

namespace roomwise::create {
namespace {

constexpr double kMilli = 1e-3;
constexpr double kDegree_rad = std::numbers::pi / 180.0;

std::int8_t flag(bool is_set) { return is_set ? 1 : 0; }

std::int8_t flag(const SensorPackets& packets, Packet packet, int bit = 0) {
  return flag((packets[packet] >> bit & 1) != 0);
}

/// Create 1 says 255 where Create 2 says 0: no infrared heard.
std::int16_t infrared(Model model, int byte) {
  return static_cast<std::int16_t>(model == Model::kCreate1 && byte == 255 ? 0 : byte);
}

void fill_contacts(Model model, const SensorPackets& packets, create_state_t& message) {
  const bool has_caster_switch = model == Model::kCreate1;
  message.bump_right = flag(packets, Packet::kBumpsAndDrops, 0);
  message.bump_left = flag(packets, Packet::kBumpsAndDrops, 1);
  message.drop_right = flag(packets, Packet::kBumpsAndDrops, 2);
  message.drop_left = flag(packets, Packet::kBumpsAndDrops, 3);
  message.drop_caster =
      has_caster_switch ? flag(packets, Packet::kBumpsAndDrops, 4) : std::int8_t{0};
  message.cliff_left = flag(packets, Packet::kCliffLeft);
  message.cliff_front_left = flag(packets, Packet::kCliffFrontLeft);
  message.cliff_front_right = flag(packets, Packet::kCliffFrontRight);
  message.cliff_right = flag(packets, Packet::kCliffRight);
  message.wall = flag(packets, Packet::kWall);
  message.virtual_wall = flag(packets, Packet::kVirtualWall);
}

/// Bits of packet 14: 0 side brush or low side driver 1, 1 low side driver 0 (Create 1), 2 main
/// brush or low side driver 2, 3 right wheel, 4 left wheel.
void fill_overcurrents(Model model, const SensorPackets& packets, create_state_t& message) {
  const bool is_create1 = model == Model::kCreate1;
  message.overcurrent_side_brush = flag(packets, Packet::kOvercurrents, is_create1 ? 1 : 0);
  message.overcurrent_driver_1 =
      is_create1 ? flag(packets, Packet::kOvercurrents, 0) : std::int8_t{0};
  message.overcurrent_main_brush = flag(packets, Packet::kOvercurrents, 2);
  message.overcurrent_right_wheel = flag(packets, Packet::kOvercurrents, 3);
  message.overcurrent_left_wheel = flag(packets, Packet::kOvercurrents, 4);
}

void fill_light(Model model, const SensorPackets& packets, create_state_t& message) {
  message.infrared_omni = infrared(model, packets[Packet::kInfraredOmni]);
  message.infrared_left = infrared(model, packets[Packet::kInfraredLeft]);
  message.infrared_right = infrared(model, packets[Packet::kInfraredRight]);
  message.wall_signal = packets[Packet::kWallSignal];
  message.cliff_signals[0] = packets[Packet::kCliffLeftSignal];
  message.cliff_signals[1] = packets[Packet::kCliffFrontLeftSignal];
  message.cliff_signals[2] = packets[Packet::kCliffFrontRightSignal];
  message.cliff_signals[3] = packets[Packet::kCliffRightSignal];
  message.light_bumper_bits = static_cast<std::int8_t>(packets[Packet::kLightBumper] & 0x3F);
  message.light_signals[0] = packets[Packet::kLightLeft];
  message.light_signals[1] = packets[Packet::kLightFrontLeft];
  message.light_signals[2] = packets[Packet::kLightCenterLeft];
  message.light_signals[3] = packets[Packet::kLightCenterRight];
  message.light_signals[4] = packets[Packet::kLightFrontRight];
  message.light_signals[5] = packets[Packet::kLightRight];
}

void fill_power(const SensorPackets& packets, create_state_t& message) {
  message.charging_state = static_cast<std::int8_t>(packets[Packet::kChargingState] & 0x7F);
  message.charger_plugged = flag(packets, Packet::kChargingSources, 0);
  message.on_home_base = flag(packets, Packet::kChargingSources, 1);
  message.battery_v = kMilli * packets[Packet::kVoltage_mv];
  message.battery_a = kMilli * packets[Packet::kCurrent_ma];
  message.battery_c = packets[Packet::kTemperature_c];
  message.battery_charge_ah = kMilli * packets[Packet::kCharge_mah];
  message.battery_capacity_ah = kMilli * packets[Packet::kCapacity_mah];
  message.left_wheel_a = kMilli * packets[Packet::kLeftMotorCurrent_ma];
  message.right_wheel_a = kMilli * packets[Packet::kRightMotorCurrent_ma];
  message.main_brush_a = kMilli * packets[Packet::kMainBrushCurrent_ma];
  message.side_brush_a = kMilli * packets[Packet::kSideBrushCurrent_ma];
}

void fill_motion(const SensorPackets& packets, create_state_t& message) {
  message.requested_left_mps = kMilli * packets[Packet::kRequestedLeft_mmps];
  message.requested_right_mps = kMilli * packets[Packet::kRequestedRight_mmps];
  message.requested_speed_mps = kMilli * packets[Packet::kRequestedVelocity_mmps];
  message.requested_radius_mm = packets[Packet::kRequestedRadius_mm];
  message.encoder_left_ticks = packets[Packet::kEncoderLeft];
  message.encoder_right_ticks = packets[Packet::kEncoderRight];
  message.travelled_m = kMilli * packets[Packet::kDistance_mm];
  message.turned_rad = kDegree_rad * packets[Packet::kAngle_deg];
  message.progress = flag(packets, Packet::kStasis);
}

void fill_panel(Model model, const SensorPackets& packets, create_state_t& message) {
  const auto small = [&](Packet packet) { return static_cast<std::int16_t>(packets[packet]); };
  const bool has_cargo_bay = model == Model::kCreate1;
  message.dirt = small(Packet::kDirt);
  message.buttons = small(Packet::kButtons);
  message.digital_inputs = has_cargo_bay ? small(Packet::kDigitalInputs) : std::int16_t{0};
  message.analog_input = has_cargo_bay ? packets[Packet::kAnalogInput] : 0;
  message.song = small(Packet::kSongNumber);
  message.song_playing = flag(packets, Packet::kSongPlaying);
  message.stream_packets = small(Packet::kStreamPackets);
}

}  // namespace

create_state_t to_message(Time time, Model model, const SensorPackets& packets, OiMode mode) {
  create_state_t message{};
  message.utime = utime_of(time);
  message.model = static_cast<std::int8_t>(model);
  message.mode = static_cast<std::int8_t>(mode);
  message.mode_byte = static_cast<std::int16_t>(packets[Packet::kOiMode]);
  fill_contacts(model, packets, message);
  fill_overcurrents(model, packets, message);
  fill_light(model, packets, message);
  fill_power(packets, message);
  fill_motion(packets, message);
  fill_panel(model, packets, message);
  return message;
}

odometry_t to_message(const OdometryStep& step) {
  odometry_t message{};
  message.utime = utime_of(step.time);
  message.interval_us = step.interval.count();
  message.reset_counter = step.reset_counter;
  message.source =
      step.source == OdometrySource::kWheels ? odometry_t::SOURCE_WHEELS : odometry_t::SOURCE_BODY;
  message.encoder_left_ticks = step.encoder_left_ticks;
  message.encoder_right_ticks = step.encoder_right_ticks;
  message.wheel_left_increment_m = step.wheel_left_m;
  message.wheel_right_increment_m = step.wheel_right_m;
  message.distance_increment_m = step.distance_m;
  message.turn_increment_rad = step.turn_rad;
  message.covariance_distance_distance_m2 = step.covariance(0, 0);
  message.covariance_distance_turn_m_rad = step.covariance(0, 1);
  message.covariance_turn_turn_rad2 = step.covariance(1, 1);
  message.x_m = step.T_odom_robot.x_m;
  message.y_m = step.T_odom_robot.y_m;
  message.heading_rad = step.T_odom_robot.heading_rad;
  return message;
}

}  // namespace roomwise::create
