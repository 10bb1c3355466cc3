#include "tests/ekf_svc/support/corridor_messages.h"

namespace roomwise::ekf {
namespace {

constexpr std::int64_t kStep_us = 100'000;

}  // namespace

odometry_t CorridorMessages::drive() {
  const MotionIncrement motion = world_.drive();
  T_odom_robot_ = moved(T_odom_robot_, motion);
  utime_ += kStep_us;
  odometry_t message{};
  message.utime = utime_;
  message.interval_us = kStep_us;
  message.distance_increment_m = motion.translation_m.norm();
  message.turn_increment_rad = motion.turn_rad;
  message.covariance_distance_distance_m2 = motion.covariance(1, 1);
  message.covariance_turn_turn_rad2 = motion.covariance(0, 0);
  message.x_m = T_odom_robot_.x_m;
  message.y_m = T_odom_robot_.y_m;
  message.heading_rad = T_odom_robot_.heading_rad;
  return message;
}

landmark_list_t CorridorMessages::look() {
  landmark_list_t message{};
  message.utime = utime_;
  for (const CorridorWorld::Seen& seen : world_.look()) {
    landmark_observation_t landmark{};
    landmark.identity = -1;
    landmark.kind = static_cast<std::int8_t>(seen.sighting.kind + 1);
    landmark.range_m = seen.sighting.polar.range_m;
    landmark.bearing_rad = seen.sighting.polar.bearing_rad;
    landmark.covariance_range_range_m2 = seen.sighting.polar.covariance(0, 0);
    landmark.covariance_bearing_bearing_rad2 = seen.sighting.polar.covariance(1, 1);
    landmark.chroma_variance_log2 = 1e6;
    message.landmarks.push_back(landmark);
  }
  message.count = static_cast<std::int32_t>(message.landmarks.size());
  return message;
}

}  // namespace roomwise::ekf
