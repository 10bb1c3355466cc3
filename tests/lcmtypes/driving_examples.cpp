// Examples of the messages between the robot and who drives it.
#include "tests/lcmtypes/examples.h"

namespace roomwise {
namespace {

constexpr std::int64_t kUtime = 1'700'000'000'123'456;

}  // namespace

template <>
create_state_t example() {
  return {.utime = kUtime,
          .seq = 17,
          .model = create_state_t::MODEL_CREATE_2,
          .driver_state = create_state_t::DRIVER_DRIVING,
          .commanded_left_mps = 1.50,
          .commanded_right_mps = 1.75,
          .mode = create_state_t::MODE_SAFE,
          .mode_byte = 8,
          .mode_drops = 2009,
          .robot_restarts = 2010,
          .refused_unsigned = 3001,
          .refused_forged = 3002,
          .refused_expired = 3003,
          .refused_from_future = 3004,
          .refused_out_of_order = 3005,
          .refused_other_session = 3006,
          .refused_malformed = 3007,
          .bump_left = 1,
          .bump_right = 0,
          .drop_left = 1,
          .drop_right = 0,
          .drop_caster = 1,
          .cliff_left = 0,
          .cliff_front_left = 1,
          .cliff_front_right = 0,
          .cliff_right = 1,
          .wall = 0,
          .virtual_wall = 1,
          .overcurrent_left_wheel = 0,
          .overcurrent_right_wheel = 1,
          .overcurrent_main_brush = 0,
          .overcurrent_side_brush = 1,
          .overcurrent_driver_1 = 0,
          .dirt = 27,
          .buttons = 28,
          .infrared_omni = 29,
          .infrared_left = 30,
          .infrared_right = 31,
          .wall_signal = 2032,
          .cliff_signals = {1033, 1034, 1035, 1036},
          .light_bumper_bits = 0,
          .light_signals = {1039, 1040, 1041, 1042, 1043, 1044},
          .charging_state = create_state_t::CHARGING_TRICKLE,
          .charger_plugged = 1,
          .on_home_base = 0,
          .battery_v = 12.50,
          .battery_a = 12.75,
          .battery_c = 13.00,
          .battery_charge_ah = 13.25,
          .battery_capacity_ah = 13.50,
          .left_wheel_a = 13.75,
          .right_wheel_a = 14.00,
          .main_brush_a = 14.25,
          .side_brush_a = 14.50,
          .requested_left_mps = 14.75,
          .requested_right_mps = 15.00,
          .requested_speed_mps = 15.25,
          .requested_radius_mm = 2061,
          .encoder_left_ticks = 2062,
          .encoder_right_ticks = 2063,
          .travelled_m = 16.25,
          .turned_rad = 16.50,
          .progress = 0,
          .digital_inputs = 67,
          .analog_input = 2068,
          .song = 69,
          .song_playing = 0,
          .stream_packets = 71};
}

template <>
odometry_t example() {
  return {.utime = kUtime,
          .seq = 11,
          .interval_us = 15'000,
          .reset_counter = 2,
          .source = odometry_t::SOURCE_WHEELS,
          .encoder_left_ticks = 65'530,
          .encoder_right_ticks = 5,
          .wheel_left_increment_m = 0.004,
          .wheel_right_increment_m = 0.005,
          .distance_increment_m = 0.0045,
          .turn_increment_rad = 0.0043,
          .covariance_distance_distance_m2 = 0.000001,
          .covariance_distance_turn_m_rad = -0.0000001,
          .covariance_turn_turn_rad2 = 0.000002,
          .x_m = 1.25,
          .y_m = -0.75,
          .heading_rad = 3.0};
}

template <>
velocity_command_t example() {
  return {.utime = kUtime,
          .seq = 18,
          .allowed_speed_mps = 0.25,
          .allowed_turn_rate_radps = -0.5,
          .reason = velocity_command_t::REASON_AS_ASKED,
          .expiry_utime = kUtime + 200'000,
          .session = 0x1234'5678'9ABC'DEF0,
          .sequence = 41,
          .signature_size = 3,
          .signature = {7, 8, 9}};
}

template <>
velocity_request_t example() {
  return {.utime = kUtime,
          .seq = 19,
          .source = "viewer",
          .priority = velocity_request_t::PRIORITY_PERSON,
          .valid_for_us = 250'000,
          .requested_speed_mps = 0.2,
          .requested_turn_rate_radps = 0.4};
}

template <>
safety_state_t example() {
  return {.utime = kUtime,
          .seq = 20,
          .state = safety_state_t::STATE_SLOW,
          .latch_id = 77,
          .reason_count = 2,
          .reasons = {velocity_command_t::REASON_OBSTACLE, velocity_command_t::REASON_UNKNOWN},
          .reason_text = "obstacle 0.41 m ahead",
          .request_source = "pilot_svc",
          .asked_speed_mps = 0.3,
          .asked_turn_rate_radps = 0.1,
          .granted_speed_mps = 0.15,
          .granted_turn_rate_radps = 0.05,
          .speed_limit_mps = 0.16,
          .nearest_distance_m = 0.41,
          .nearest_x_m = 0.6,
          .nearest_y_m = -0.05,
          .corridor_unknown_ratio = 0.12,
          .reverse_allowance_m = 0.75,
          .segments_age_s = 0.034,
          .kinect_frame_age_s = 0.03,
          .odometry_age_s = 0.011,
          .create_state_age_s = 0.012,
          .request_age_s = 0.06};
}

template <>
estop_t example() {
  return {.utime = kUtime, .seq = 21, .source = "viewer", .held = 1, .cause = "space bar"};
}

template <>
safety_reset_t example() {
  return {.utime = kUtime, .seq = 22, .source = "viewer", .latch_id = 77};
}

template <>
pilot_goal_t example() {
  return {.utime = kUtime,
          .seq = 23,
          .source = "viewer",
          .behaviour = pilot_goal_t::BEHAVIOUR_CIRCLE,
          .goal_speed_mps = 0.25,
          .goal_duration_s = 90.0,
          .goal_x_m = 1.5,
          .goal_y_m = -2.5,
          .circle_distance_m = 0.5,
          .circle_sense = -1,
          .circle_rounds_ratio = 1.25};
}

template <>
pilot_state_t example() {
  return {.utime = kUtime,
          .seq = 24,
          .goal_utime = kUtime - 5,
          .behaviour = pilot_goal_t::BEHAVIOUR_CIRCLE,
          .state = pilot_state_t::STATE_RECOVERING,
          .failure = pilot_state_t::FAILURE_STUCK,
          .explanation = "bumped twice",
          .progress_ratio = 0.375,
          .goal_distance_m = 2.25,
          .driven_m = 6.5,
          .turned_about_object_rad = -2.5,
          .object_distance_m = 0.52,
          .chosen_bearing_rad = 0.35,
          .recoveries = 3};
}

}  // namespace roomwise
