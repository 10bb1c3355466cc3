#pragma once
#include <random>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/simulator/core/contact.h"
#include "services/simulator/core/left_right.h"
#include "services/simulator/core/robot_params.h"

namespace roomwise::simulator {

/// One wheel and its motor.
struct Wheel {
  double speed_mps = 0.0;       ///< of its rim, by the nominal diameter
  double turned_m = 0.0;        ///< way of its rim since the start, by the nominal diameter: exact
  double held_ratio = 0.0;      ///< 0 turns as it should by now, 1 stands still against its motor
  double held_s = 0.0;          ///< for how long it has been held back by more than half
  bool dropped = false;         ///< hangs over a hole
  double slip_ratio = 0.0;      ///< of the stretch of floor it is on now
  double stretch_left_m = 0.0;  ///< way left of that stretch
};

/// The robot in the plane: two driven wheels with slip, stopped and guided by what it touches.
///
/// A wheel's rim follows the commanded speed as fast as its motor can. What the two rims roll, each
/// times its own diameter's ratio and less its slip, moves the centre along the mid heading by
/// (l + r) / 2 and turns it by (r - l) / base. Where the ground plan does not let the body go that
/// far, both wheels are held back by the same amount, none beyond standing still: held wheels count
/// no ticks. Met at less than 45 degrees, a wall is slid along; steeper, the wheels stall. A robot
/// with a wheel over a hole hangs there, its wheels turning freely.
///
/// Same seed, same calls: the same bits.
class RobotMotion {
 public:
  /// `nominal_base_m`: between the wheels, as the firmware believes it.
  RobotMotion(const RobotParams& params, double nominal_base_m, const Pose2& T_world_robot,
              std::mt19937_64 random);

  /// Moves on by `dt_s`, a millisecond or so, with the wheels commanded to these rim speeds.
  void step(const GroundPlan& plan, const LeftRight<double>& command_mps, double dt_s);

  const Pose2& pose() const { return T_world_robot_; }
  const LeftRight<Wheel>& wheels() const { return wheels_; }

  /// Bodies touched now.
  const std::vector<Touch>& touches() const { return touches_; }

 private:
  using Travel = LeftRight<double>;

  void spin_up(Wheel& wheel, double command_mps, double dt_s) const;
  double rolled_m(Wheel& wheel, double wheel_ratio, double dt_s);
  Travel move_body(const GroundPlan& plan, const Travel& rolled_m);
  void turn_wheel(Wheel& wheel, double share, double command_mps, double dt_s) const;
  bool hangs(const GroundPlan& plan, double side_m) const;

  RobotParams params_;
  double nominal_base_m_;
  Pose2 T_world_robot_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  LeftRight<Wheel> wheels_;
  std::vector<Touch> touches_;
};

}  // namespace roomwise::simulator
