#include "services/safety_svc/safety_messages.h"

#include <algorithm>
#include <chrono>
#include <span>

namespace roomwise::safety {
namespace {

/// How long a command may be obeyed: as long as create_driver obeys any.
constexpr Duration kCommandLife = std::chrono::milliseconds(200);
constexpr double kDropOffFraction = 0.005;  // of all pixels: some 1500 of 640 x 480
constexpr int kAheadBumpers = 0b011110;     // light bumpers but the outermost: what is ahead

static_assert(static_cast<int>(Reason::kCharging) == velocity_command_t::REASON_CHARGING);
static_assert(static_cast<int>(Reason::kObstacle) == velocity_command_t::REASON_OBSTACLE);
static_assert(static_cast<int>(Reason::kClock) == velocity_command_t::REASON_CLOCK);

/// An array of a message. Decoding an empty one leaves what the message held before: its size alone
/// counts.
std::span<const double> array_of(const std::vector<double>& values, std::int32_t count) {
  return std::span(values).first(std::min(values.size(), static_cast<std::size_t>(count)));
}

bool sees_drop_off(const segmentation_t& message) {
  const auto classes = static_cast<std::size_t>(message.class_count);
  for (std::size_t i = 0; i < std::min(classes, message.class_label.size()); ++i) {
    if (message.class_label[i] == segmentation_t::LABEL_DROP_OFF) {
      return message.class_fraction_ratio[i] > kDropOffFraction;
    }
  }
  return false;
}

std::int8_t state_of(const World& world, const Decision& decision) {
  if (world.estop.is_latched()) return safety_state_t::STATE_ESTOP;
  if (decision.reasons.is_empty()) return safety_state_t::STATE_RUN;
  const bool stands = decision.granted.speed_mps == 0.0 && decision.granted.turn_rate_radps == 0.0;
  return stands ? safety_state_t::STATE_STOP : safety_state_t::STATE_SLOW;
}

void append_reason(Reason reason, safety_state_t& message) {
  message.reasons.push_back(static_cast<std::int16_t>(reason));
  if (!message.reason_text.empty()) message.reason_text += ", ";
  message.reason_text += words_of(reason);
}

void fill_reasons(const Decision& decision, safety_state_t& message) {
  message.reasons.clear();
  message.reason_text.clear();
  if (!decision.reasons.is_empty()) append_reason(decision.first, message);
  for (std::size_t i = 0; i < kReasons; ++i) {
    const auto reason = static_cast<Reason>(i);
    if (decision.reasons.has(reason) && reason != decision.first) append_reason(reason, message);
  }
  message.reason_count = static_cast<std::int32_t>(message.reasons.size());
}

void fill_request(const Instant& now, const World& world, safety_state_t& message) {
  const RequestArbiter::Slot* const heard = world.requests.winner(now);
  message.request_source = heard == nullptr ? "" : heard->source;
  message.asked_speed_mps = heard == nullptr ? 0.0 : heard->request.speed_mps;
  message.asked_turn_rate_radps = heard == nullptr ? 0.0 : heard->request.turn_rate_radps;
  message.request_age_s = heard == nullptr ? -1.0 : seconds(now.steady - heard->received);
}

}  // namespace

OdometrySample sample_of(const odometry_t& message) {
  return {.time = time_from_utime(message.utime),
          .interval = Duration(message.interval_us),
          .distance_m = message.distance_increment_m,
          .turn_rad = message.turn_increment_rad,
          .T_odom_robot = {message.x_m, message.y_m, message.heading_rad},
          .reset_counter = message.reset_counter};
}

CameraSetup setup_of(const kinect_frame_t& message) {
  const double* const p_m = message.T_robot_camera_translation_m;
  const double* const q = message.T_robot_camera_quat;
  return {.p_robot_camera_m = {p_m[0], p_m[1], p_m[2]},
          .quat_wxyz = {q[0], q[1], q[2], q[3]},
          .fy_px = message.depth_fy_px,
          .cy_px = message.depth_cy_px,
          .height_px = message.depth_height_px};
}

FloorView view_of(const segmentation_t& message) {
  const double* const normal = message.floor_normal_ratio;
  return {.time = time_from_utime(message.utime),
          .free = {.first_bearing_rad = message.bin_first_bearing_rad,
                   .bearing_step_rad = message.bin_step_rad,
                   .free_range_m = array_of(message.free_range_m, message.bin_count),
                   .unknown_ratio = array_of(message.unknown_ratio, message.bin_count),
                   .obstacle_range_m = array_of(message.obstacle_range_m, message.bin_count),
                   .has_drop_off = sees_drop_off(message)},
          .is_plane_trusted = message.floor_trusted != 0,
          .floor_normal = {normal[0], normal[1], normal[2]},
          .floor_height_m = message.floor_height_m};
}

BodyState body_of(const create_state_t& message) {
  const bool has_mode =
      message.mode == create_state_t::MODE_SAFE || message.mode == create_state_t::MODE_FULL;
  const bool has_driver = message.driver_state == create_state_t::DRIVER_DRIVING ||
                          message.driver_state == create_state_t::DRIVER_SILENT;
  return {
      .is_in_driving_mode = has_mode && has_driver,
      .bump = message.bump_left != 0 || message.bump_right != 0,
      .cliff = message.cliff_left != 0 || message.cliff_front_left != 0 ||
               message.cliff_front_right != 0 || message.cliff_right != 0,
      .wheel_drop = message.drop_left != 0 || message.drop_right != 0 || message.drop_caster != 0,
      .virtual_wall = message.virtual_wall != 0,
      .near_wall = message.wall != 0 || (message.light_bumper_bits & kAheadBumpers) != 0,
      .overcurrent = message.overcurrent_left_wheel != 0 || message.overcurrent_right_wheel != 0,
      .is_charging = message.charger_plugged != 0 || message.on_home_base != 0};
}

Asked asked_of(const velocity_request_t& message) {
  return {.request = {message.requested_speed_mps, message.requested_turn_rate_radps},
          .source = message.source,
          .priority = message.priority,
          .valid_for = Duration(message.valid_for_us),
          .decided = time_from_utime(message.utime)};
}

velocity_command_t command_of(const Instant& now, const Decision& decision) {
  velocity_command_t command{};
  command.utime = utime_of(now.wall);
  command.allowed_speed_mps = decision.granted.speed_mps;
  command.allowed_turn_rate_radps = decision.granted.turn_rate_radps;
  command.reason = static_cast<std::int8_t>(decision.first);
  command.expiry_utime = utime_of(now.wall + kCommandLife);
  return command;
}

void fill(const Instant& now, const World& world, const Decision& decision,
          safety_state_t& message) {
  message.utime = utime_of(now.wall);
  message.state = state_of(world, decision);
  message.latch_id = world.estop.latch_id();
  fill_reasons(decision, message);
  fill_request(now, world, message);
  message.granted_speed_mps = decision.granted.speed_mps;
  message.granted_turn_rate_radps = decision.granted.turn_rate_radps;
  message.speed_limit_mps = decision.speed_limit_mps;
  message.nearest_distance_m = decision.corridor.free_m;
  message.nearest_x_m = decision.corridor.p_robot_end_m.x();
  message.nearest_y_m = decision.corridor.p_robot_end_m.y();
  message.corridor_unknown_ratio = decision.corridor.unknown_ratio;
  message.reverse_allowance_m = decision.reverse_way_m;
  message.segments_age_s = world.view.age_s(now);
  message.kinect_frame_age_s = world.frame.age_s(now);
  message.odometry_age_s = world.odometry.age_s(now);
  message.create_state_age_s = world.body_state.age_s(now);
}

}  // namespace roomwise::safety
