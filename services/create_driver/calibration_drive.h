#pragma once
#include <atomic>
#include <cstdint>

#include "services/create_driver/core/calibration.h"
#include "services/create_driver/core/create_driver.h"
#include "services/create_driver/device/robot_link.h"

namespace roomwise::create {

/// Drives a Create from the port itself, without the bus, for measuring its wheels. Slow, with the
/// guardian, and it stops for whatever the robot feels: there is no safety_svc here.
class CalibrationDrive {
 public:
  /// Throws std::runtime_error if no robot is ready to drive within ten seconds. `is_over`: set by
  /// a signal, ends every drive by an exception.
  CalibrationDrive(const CreateParams& params, const std::atomic<bool>& is_over);

  /// Drives until odometry says `distance_m` (> 0), and stops.
  WheelTicks straight(double distance_m);

  /// Turns counter-clockwise until odometry says `turn_rad` (> 0), and stops.
  WheelTicks spin(double turn_rad);

  /// Keeps the robot standing and its guardian content while `is_waiting()`.
  template <class Condition>
  void stand_while(Condition is_waiting) {
    while (is_waiting()) turn_over(0.0, 0.0);
  }

 private:
  void wait_until_ready();
  void turn_over(double speed_mps, double turn_rate_radps);
  void add(const FrameReport& report);
  void come_to_rest();

  CreateDriver driver_;
  RobotLink link_;
  const std::atomic<bool>& is_over_;
  std::int64_t sequence_ = 0;
  DriverState state_ = DriverState::kStarting;
  SensorPackets packets_;
  bool has_reading_ = false;
  WheelTicks ticks_;
  double distance_m_ = 0.0;
  double turn_rad_ = 0.0;
};

}  // namespace roomwise::create
