#pragma once
#include <cstdint>

#include "common/create/encoder_odometry.h"
#include "common/create/odometry_step.h"

namespace roomwise::create {

/// What a robot does with the part of a unit that its whole-number reading leaves out.
enum class Rounding : std::uint8_t {
  kTruncate,  ///< forgets it at every reading: slow motion reads 0 for ever
  kCarry,     ///< keeps it for the next reading
};

/// Makes the best of whole-number readings of a motion by what the motion was expected to be: the
/// expectation, moved into the interval that the reading allows.
///   kTruncate: reading n > 0 allows [n, n + 1], 0 allows [-1, 1], n < 0 allows [n - 1, n];
///   kCarry: the sum of all readings is less than 1 from the sum of all motion.
class RoundedMotion {
 public:
  explicit RoundedMotion(Rounding rounding) : rounding_(rounding) {}

  /// Motion since the last reading, in the reading's unit.
  double refine(int reading, double expected);

 private:
  Rounding rounding_;
  double carried_ = 0.0;  // motion so far less the readings so far, in (-1, 1)
};

/// Pose from the distance (mm) and angle (degrees) a Create 1 gives, packets 19 and 20, which count
/// from one reading to the next. Between readings the wheel speeds the robot was asked for say
/// what to expect, so that motion too slow to be read is not lost.
///
/// Covariance: slip as of EncoderOdometry, and for what moves the rounding error of a reading,
/// uniform over one unit: (1 mm)^2 / 12, (1 degree)^2 / 12.
class BodyOdometry {
 public:
  BodyOdometry(const WheelGeometry& geometry, Rounding rounding);

  /// The robot was asked to drive at these wheel speeds for `interval`.
  void expect(Duration interval, double left_mps, double right_mps);

  /// Takes one reading. After kGap and kJump the pose starts anew at the origin.
  [[nodiscard]] OdometryVerdict update(Time time, int distance_mm, int angle_deg);

  /// A reading got lost on its way, and with it the motion since the one before: the next step
  /// counts what was expected in its place, with little trust.
  void reading_lost();

  /// The robot is not what it was: the next reading starts anew.
  void rebase();

  /// The newest step; meaningful after kStep.
  const OdometryStep& step() const { return step_; }

 private:
  struct Motion {
    double distance_m = 0.0;
    double turn_rad = 0.0;
  };
  OdometryVerdict judge(Time time, int distance_mm, int angle_deg) const;
  void advance(int distance_mm, int angle_deg);
  Eigen::Matrix2d covariance_of(const Motion& read, const Motion& unread) const;

  WheelGeometry geometry_;
  RoundedMotion distance_mm_;
  RoundedMotion angle_deg_;
  Motion expected_;  // since the last reading
  Motion unread_;    // expected where readings were lost
  bool has_reading_ = false;
  bool has_run_ = false;
  OdometryStep step_;
};

}  // namespace roomwise::create
