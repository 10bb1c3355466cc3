#include "services/simulator/core/create/body_sensors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/simulator/core/contact.h"

namespace roomwise::simulator {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

constexpr double kBumperReach_rad = 90.0 * kDegree_rad;
constexpr double kBothBumpers_rad = 10.0 * kDegree_rad;
constexpr std::array kCliffBearings_rad = {60.0 * kDegree_rad, 15.0 * kDegree_rad,
                                           -15.0 * kDegree_rad, -60.0 * kDegree_rad};
constexpr double kCliffInset_m = 0.015;
constexpr std::uint16_t kFloorSignal = 2600;
constexpr std::uint16_t kNoFloorSignal = 10;

constexpr std::array kLightBearings_rad = {65.0 * kDegree_rad,  38.0 * kDegree_rad,
                                           13.0 * kDegree_rad,  -13.0 * kDegree_rad,
                                           -38.0 * kDegree_rad, -65.0 * kDegree_rad};
constexpr double kWallBearing_rad = -70.0 * kDegree_rad;
constexpr double kBeam_m = 0.3;
constexpr double kBeamHalf_m = 0.05;  ///< a signal is a quarter of its largest this far off
constexpr double kLargestLight = 4095.0;
constexpr double kLargestWall = 1023.0;
constexpr std::uint16_t kWallBit = 100;

constexpr double kRollingCurrent_ma = 80.0;
constexpr double kCurrentPerSpeed_ma = 500.0;  ///< at 1 m/s
constexpr double kHeldCurrent_ma = 1200.0;

double signal(double largest, double way_m) {
  const double ratio = kBeamHalf_m / (kBeamHalf_m + way_m);
  return way_m < kBeam_m ? largest * ratio * ratio : 0.0;
}

class Rim {
 public:
  Rim(const Pose2& T_world_robot, double radius_m)
      : T_world_robot_(T_world_robot), radius_m_(radius_m) {}

  Eigen::Vector2d direction(double bearing_rad) const {
    const double angle = T_world_robot_.heading_rad + bearing_rad;
    return {std::cos(angle), std::sin(angle)};
  }
  Eigen::Vector2d point_m(double bearing_rad, double inset_m) const {
    return T_world_robot_.position_m() + (radius_m_ - inset_m) * direction(bearing_rad);
  }
  double free_way_m(const GroundPlan& plan, double bearing_rad) const {
    return simulator::free_way_m(plan, point_m(bearing_rad, 0.0), direction(bearing_rad), kBeam_m);
  }

 private:
  Pose2 T_world_robot_;
  double radius_m_;
};

LeftRight<bool> pressed_bumpers(const RobotMotion& motion) {
  LeftRight<bool> pressed;
  for (const Touch& touch : motion.touches()) {
    const double bearing = wrap_angle(std::atan2(touch.direction.y(), touch.direction.x()) -
                                      motion.pose().heading_rad);
    if (std::abs(bearing) > kBumperReach_rad) continue;
    pressed.left |= bearing > -kBothBumpers_rad;
    pressed.right |= bearing < kBothBumpers_rad;
  }
  return pressed;
}

std::int16_t current_ma(const Wheel& wheel) {
  const double speed_mps = std::abs(wheel.speed_mps);
  const double rolling =
      speed_mps > 0.0 ? kRollingCurrent_ma + kCurrentPerSpeed_ma * speed_mps : 0.0;
  const double held = wheel.held_s > 0.0 ? kHeldCurrent_ma * wheel.held_ratio : 0.0;
  return static_cast<std::int16_t>(rolling + held);
}

void read_wheels(const LeftRight<Wheel>& wheels, double stall_after_s, BodyReadings& readings) {
  readings.wheel_drop = {wheels.left.dropped, wheels.right.dropped};
  readings.caster_drop = wheels.left.dropped && wheels.right.dropped;
  readings.overcurrent = {wheels.left.held_s > stall_after_s, wheels.right.held_s > stall_after_s};
  readings.wheel_current_ma = {current_ma(wheels.left), current_ma(wheels.right)};
  readings.encoder_ticks = {encoder_ticks(wheels.left.turned_m),
                            encoder_ticks(wheels.right.turned_m)};
  readings.turned_m = {wheels.left.turned_m, wheels.right.turned_m};
}

}  // namespace

std::uint16_t encoder_ticks(double turned_m) {
  const auto ticks = static_cast<std::int64_t>(std::floor(turned_m / kTravelPerTick_m));
  return static_cast<std::uint16_t>(ticks & 0xFFFF);
}

BodyReadings read_body(const RobotMotion& motion, const GroundPlan& plan,
                       const RobotParams& params) {
  BodyReadings readings;
  const Rim rim(motion.pose(), params.radius_m);
  readings.bump = pressed_bumpers(motion);
  for (std::size_t i = 0; i < kCliffBearings_rad.size(); ++i) {
    readings.cliff[i] = over_hole(plan, rim.point_m(kCliffBearings_rad[i], kCliffInset_m));
    readings.cliff_signal[i] = readings.cliff[i] ? kNoFloorSignal : kFloorSignal;
  }
  for (std::size_t i = 0; i < kLightBearings_rad.size(); ++i) {
    const double way_m = rim.free_way_m(plan, kLightBearings_rad[i]);
    readings.light_signal[i] = static_cast<std::uint16_t>(signal(kLargestLight, way_m));
  }
  const double wall_way_m = rim.free_way_m(plan, kWallBearing_rad);
  readings.wall_signal = static_cast<std::uint16_t>(signal(kLargestWall, wall_way_m));
  readings.wall = readings.wall_signal >= kWallBit;
  read_wheels(motion.wheels(), params.stall_after_s, readings);
  return readings;
}

}  // namespace roomwise::simulator
