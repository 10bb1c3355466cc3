#include "common/create/body_odometry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace roomwise::create {
namespace {

constexpr double kMetre_mm = 1000.0;
constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr Duration kLongestUnread = std::chrono::seconds(5);
constexpr double kBodySpeedMax_mps = 0.75;
constexpr double kBodyTurnRateMax_radps = 6.0;
constexpr double kBunchingSlack_s = 0.3;    // readings that waited for a busy host come in bunches
constexpr double kUnreadTrust_ratio = 0.3;  // sigma of motion expected but not read

double square(double value) { return value * value; }

}  // namespace

double RoundedMotion::refine(int reading, double expected) {
  if (rounding_ == Rounding::kTruncate) {
    return std::clamp(expected, reading - (reading <= 0 ? 1.0 : 0.0),
                      reading + (reading >= 0 ? 1.0 : 0.0));
  }
  const double before = carried_;
  carried_ = std::clamp(carried_ + expected - reading, -1.0, 1.0);
  return reading + carried_ - before;
}

BodyOdometry::BodyOdometry(const WheelGeometry& geometry, Rounding rounding)
    : geometry_(geometry), distance_mm_(rounding), angle_deg_(rounding) {
  step_.source = OdometrySource::kBody;
}

void BodyOdometry::expect(Duration interval, double left_mps, double right_mps) {
  expected_.distance_m += 0.5 * (left_mps + right_mps) * seconds(interval);
  expected_.turn_rad += (right_mps - left_mps) / geometry_.wheel_base_m * seconds(interval);
}

void BodyOdometry::reading_lost() {
  unread_.distance_m += expected_.distance_m;
  unread_.turn_rad += expected_.turn_rad;
  expected_ = {};
}

void BodyOdometry::rebase() {
  if (has_run_) ++step_.reset_counter;
  step_.T_odom_robot = {};
  expected_ = {};
  unread_ = {};
  has_reading_ = false;
  has_run_ = false;
}

OdometryVerdict BodyOdometry::update(Time time, int distance_mm, int angle_deg) {
  const OdometryVerdict verdict = judge(time, distance_mm, angle_deg);
  if (verdict == OdometryVerdict::kOutOfOrder) return verdict;
  if (verdict == OdometryVerdict::kGap || verdict == OdometryVerdict::kJump) rebase();
  step_.interval = time - step_.time;
  step_.time = time;
  has_reading_ = true;
  has_run_ = true;
  if (verdict == OdometryVerdict::kStep) advance(distance_mm, angle_deg);
  expected_ = {};
  unread_ = {};
  return verdict;
}

OdometryVerdict BodyOdometry::judge(Time time, int distance_mm, int angle_deg) const {
  if (!has_reading_) return OdometryVerdict::kFirst;
  const Duration interval = time - step_.time;
  if (interval <= -kLongestUnread || interval > kLongestUnread) return OdometryVerdict::kGap;
  if (interval <= Duration(0)) return OdometryVerdict::kOutOfOrder;
  const double time_s = seconds(interval) + kBunchingSlack_s;
  const bool is_jump = std::abs(distance_mm) > kBodySpeedMax_mps * time_s * kMetre_mm ||
                       std::abs(angle_deg) > kBodyTurnRateMax_radps * time_s / kDegree_rad;
  return is_jump ? OdometryVerdict::kJump : OdometryVerdict::kStep;
}

void BodyOdometry::advance(int distance_mm, int angle_deg) {
  const Motion read{distance_mm_.refine(distance_mm, expected_.distance_m * kMetre_mm) / kMetre_mm,
                    angle_deg_.refine(angle_deg, expected_.turn_rad / kDegree_rad) * kDegree_rad};
  step_.distance_m = read.distance_m + unread_.distance_m;
  step_.turn_rad = read.turn_rad + unread_.turn_rad;
  step_.covariance = covariance_of(read, unread_);
  step_.T_odom_robot = drive_arc(step_.T_odom_robot, step_.distance_m, step_.turn_rad);
}

Eigen::Matrix2d BodyOdometry::covariance_of(const Motion& read, const Motion& unread) const {
  const double wheel = geometry_.wheel_noise_m2_per_m;
  const double base_m = geometry_.wheel_base_m;
  double distance = 0.5 * wheel * std::abs(read.distance_m);
  double turn = 2.0 * wheel * std::abs(read.distance_m) / (base_m * base_m) +
                geometry_.turn_noise_rad2_per_rad * std::abs(read.turn_rad);
  if (read.distance_m != 0.0) distance += square(1.0 / kMetre_mm) / 12.0;
  if (read.turn_rad != 0.0) turn += square(kDegree_rad) / 12.0;
  distance += square(kUnreadTrust_ratio * unread.distance_m);
  turn += square(kUnreadTrust_ratio * unread.turn_rad);
  return Eigen::Vector2d(distance, turn).asDiagonal();
}

}  // namespace roomwise::create
