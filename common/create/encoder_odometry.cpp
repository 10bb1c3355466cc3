#include "common/create/encoder_odometry.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numbers>

namespace roomwise::create {
namespace {

/// iRobot Create 2 Open Interface: 508.8 counts per turn of a 72 mm wheel.
constexpr double kTicksPerTurn = 508.8;
/// At 0.5 m/s a counter comes round half way after 29 s.
constexpr Duration kLongestGap = std::chrono::seconds(15);
/// No Create is faster; half as much again for wheels spun by hand or downhill.
constexpr double kSpeedMax_mps = 0.75;
/// Readings that waited for a busy host come in bunches.
constexpr double kTimeSlack_s = 0.2;

Eigen::Matrix2d covariance_of(const WheelGeometry& geometry, const OdometryStep& step) {
  const double left = geometry.wheel_noise_m2_per_m * std::abs(step.wheel_left_m);
  const double right = geometry.wheel_noise_m2_per_m * std::abs(step.wheel_right_m);
  const double base_m = geometry.wheel_base_m;
  const double slip = geometry.turn_noise_rad2_per_rad * std::abs(step.turn_rad);
  const double cross = (right - left) / (2.0 * base_m);
  return (Eigen::Matrix2d() << 0.25 * (left + right), cross, cross,
          (left + right) / (base_m * base_m) + slip)
      .finished();
}

}  // namespace

double WheelGeometry::metres_per_tick() const {
  return std::numbers::pi * wheel_diameter_m / kTicksPerTurn;
}

EncoderOdometry::EncoderOdometry(const WheelGeometry& geometry) : geometry_(geometry) {}

void EncoderOdometry::rebase() {
  if (has_run_) ++step_.reset_counter;
  step_.T_odom_robot = {};
  has_reading_ = false;
  has_run_ = false;
}

OdometryVerdict EncoderOdometry::update(Time time, std::uint16_t left, std::uint16_t right) {
  const int left_delta =
      encoder_delta_ticks(static_cast<std::uint16_t>(step_.encoder_left_ticks), left);
  const int right_delta =
      encoder_delta_ticks(static_cast<std::uint16_t>(step_.encoder_right_ticks), right);
  const OdometryVerdict verdict = judge(time, left_delta, right_delta);
  if (verdict == OdometryVerdict::kOutOfOrder) return verdict;
  if (verdict == OdometryVerdict::kGap || verdict == OdometryVerdict::kJump) rebase();
  step_.interval = time - step_.time;
  step_.time = time;
  step_.encoder_left_ticks = left;
  step_.encoder_right_ticks = right;
  has_reading_ = true;
  has_run_ = true;
  if (verdict == OdometryVerdict::kStep) advance(left_delta, right_delta);
  return verdict;
}

OdometryVerdict EncoderOdometry::judge(Time time, int left_delta, int right_delta) const {
  if (!has_reading_) return OdometryVerdict::kFirst;
  const Duration interval = time - step_.time;
  if (interval <= -kLongestGap || interval > kLongestGap) return OdometryVerdict::kGap;
  if (interval <= Duration(0)) return OdometryVerdict::kOutOfOrder;
  const double most_ticks =
      kSpeedMax_mps * (seconds(interval) + kTimeSlack_s) / geometry_.metres_per_tick();
  const bool is_jump = std::max(std::abs(left_delta), std::abs(right_delta)) > most_ticks;
  return is_jump ? OdometryVerdict::kJump : OdometryVerdict::kStep;
}

void EncoderOdometry::advance(int left_delta, int right_delta) {
  const double metres_per_tick = geometry_.metres_per_tick();
  step_.wheel_left_m = left_delta * metres_per_tick * geometry_.left_scale_ratio;
  step_.wheel_right_m = right_delta * metres_per_tick * geometry_.right_scale_ratio;
  step_.distance_m = 0.5 * (step_.wheel_left_m + step_.wheel_right_m);
  step_.turn_rad = (step_.wheel_right_m - step_.wheel_left_m) / geometry_.wheel_base_m;
  step_.covariance = covariance_of(geometry_, step_);
  step_.T_odom_robot = drive_arc(step_.T_odom_robot, step_.distance_m, step_.turn_rad);
}

}  // namespace roomwise::create
