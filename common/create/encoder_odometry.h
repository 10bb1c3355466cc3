#pragma once
#include <cstdint>

#include "common/create/odometry_step.h"

namespace roomwise::create {

/// Ticks turned between two readings of a wheel's 16-bit counter, which wraps both ways. Forward is
/// positive. Exact while the wheel moves fewer than 32768 ticks between readings: 14.5 m.
///
/// Source: Create 2 Open Interface, packets 43 and 44.
constexpr int encoder_delta_ticks(std::uint16_t before, std::uint16_t after) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(after - before));
}
static_assert(encoder_delta_ticks(65533, 3) == 6 && encoder_delta_ticks(3, 65533) == -6);

/// The wheels of a Create, and how far they can be trusted. Defaults: Create 2.
struct WheelGeometry {
  double wheel_base_m = 0.235;            ///< between the wheels' points of contact
  double wheel_diameter_m = 0.072;        ///< of both
  double left_scale_ratio = 1.0;          ///< true travel of the left wheel by what it says
  double right_scale_ratio = 1.0;         ///< the same of the right wheel
  double wheel_noise_m2_per_m = 2e-5;     ///< variance of a wheel's travel, per metre it travels
  double turn_noise_rad2_per_rad = 3e-4;  ///< further variance of the turn, per radian turned

  double metres_per_tick() const;
};

/// Pose by counting wheel ticks (Create 2). With wheel travels l and r, base b:
///   distance = (l + r) / 2,  turn = (r - l) / b,
/// driven as a circular arc. Covariance of (distance, turn) from independent wheel errors of
/// variance k |l| and k |r|, and slip that grows with the turn.
///
/// Does no I/O and holds no clock: the same calls give the same bits.
class EncoderOdometry {
 public:
  explicit EncoderOdometry(const WheelGeometry& geometry);

  /// Takes one reading of both counters. After kGap and kJump the pose starts anew at the origin.
  [[nodiscard]] OdometryVerdict update(Time time, std::uint16_t left, std::uint16_t right);

  /// The counters or the robot are not what they were: the next reading starts anew.
  void rebase();

  /// The newest step; meaningful after kStep.
  const OdometryStep& step() const { return step_; }

 private:
  OdometryVerdict judge(Time time, int left_delta, int right_delta) const;
  void advance(int left_delta, int right_delta);

  WheelGeometry geometry_;
  bool has_reading_ = false;
  bool has_run_ = false;  // a reading was taken since the pose was at the origin
  OdometryStep step_;
};

}  // namespace roomwise::create
