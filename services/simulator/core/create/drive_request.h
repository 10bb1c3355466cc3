#pragma once
#include <cstdint>

#include "services/simulator/core/left_right.h"

namespace roomwise::simulator {

/// What the host last asked of the wheels. There is no time limit: it holds until the next one.
class DriveRequest {
 public:
  /// Opcode 137: mm/s and mm; radius 32767 or -32768 straight, -1 clockwise and 1 counter-clockwise
  /// in place. Clamped to 500 mm/s and 2000 mm; an arc too tight for its speed is driven slower, so
  /// that neither wheel exceeds 500 mm/s.
  void set_arc(std::int16_t velocity_mmps, std::int16_t radius_mm, double wheel_base_m);

  /// Opcode 145: clamped to 500 mm/s.
  void set_direct(LeftRight<std::int16_t> mmps);

  /// Opcode 146: full power is 255.
  void set_pwm(LeftRight<std::int16_t> pwm);

  void stop() { *this = DriveRequest(); }

  const LeftRight<double>& wheels_mps() const { return wheels_mps_; }
  std::int16_t velocity_mmps() const { return velocity_mmps_; }
  std::int16_t radius_mm() const { return radius_mm_; }
  const LeftRight<std::int16_t>& direct_mmps() const { return direct_mmps_; }

  /// The centre moves ahead, or back on an arc tighter than the robot: where a cliff trips Safe
  /// mode.
  bool minds_cliffs(double wheel_base_m) const;

 private:
  LeftRight<double> wheels_mps_;
  std::int16_t velocity_mmps_ = 0;
  std::int16_t radius_mm_ = 0;
  LeftRight<std::int16_t> direct_mmps_;
};

}  // namespace roomwise::simulator
