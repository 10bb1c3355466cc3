#pragma once

namespace roomwise::simulator {

/// The simulated Create's body, and how its wheels differ from what their encoders say. What the
/// robot's own firmware believes is nominal: a 235 mm base (Create 1: 258 mm) and 72 mm wheels.
/// With the defaults dead reckoning ends a round of 40 m some 0.5 to 1.4 m off, as real ones do.
struct RobotParams {
  double radius_m = 0.17;
  double top_speed_mps = 0.5;        ///< users of the Create 2 have measured 0.33 to 0.5
  double acceleration_mps2 = 2.0;    ///< of a wheel, away from standing still
  double braking_mps2 = 5.0;         ///< of a wheel, towards standing still
  double left_wheel_ratio = 1.0004;  ///< true wheel diameter over the nominal one
  double right_wheel_ratio = 0.9996;
  double wheel_base_ratio =
      0.995;                    ///< effective base over the nominal one: tyres are wide and scrub
  double slip_ratio = 0.005;    ///< travel short of what the wheels turned
  double slip_m2_per_m = 1e-7;  ///< variance of that, a wheel and metre
  double stall_after_s = 0.3;   ///< overcurrent is reported this long after a wheel is held
};

}  // namespace roomwise::simulator
