#pragma once
#include <random>
#include <string>
#include <vector>

#include "services/pilot_svc/core/pilot.h"
#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/robot_motion.h"
#include "services/simulator/core/scene.h"

namespace roomwise::pilot {

/// How well free range is measured.
struct ViewNoise {
  double range_sigma_ratio = 0.0;    ///< of the range
  double dropout_probability = 0.0;  ///< a bin ends somewhere short
};

/// A simulator scenario as a flat world: the ground plan seen by rays, the simulator's own wheels,
/// and a stand-in for safety_svc that slows down before what it knows to be there.
class KinematicWorld {
 public:
  static constexpr double kStep_s = 0.05;

  KinematicWorld(simulator::Scene scene, const ViewNoise& noise, unsigned seed);

  /// Moves on by kStep_s with this asked for.
  void step(const Motion& asked);

  /// What SEGMENTS would say, in bins of a degree over +-45 degrees; valid until the next call.
  FreeView view();

  double time_s() const { return time_s_; }
  Pose2 T_odom_robot() const { return T_odom_robot_; }
  const Pose2& T_world_robot() const { return motion_.pose(); }
  const simulator::GroundPlan& body_plan() const { return body_plan_; }
  /// Between the rim and the nearest body.
  double clearance_m() const;
  /// Times it ran into something faster than 0.1 m/s, by its own speed toward it.
  int contacts() const { return contacts_; }
  double speed_mps() const { return granted_.speed_mps; }

 private:
  bool meets(double way_m) const;
  Motion grant(const Motion& asked) const;
  double seen_range_m(double bearing_rad);
  void see(double bearing_rad);

  simulator::Scene scene_;
  ViewNoise noise_;
  std::mt19937_64 random_;
  simulator::GroundPlan body_plan_;
  simulator::GroundPlan sight_plan_;
  simulator::GroundPlan near_plan_;
  simulator::RobotMotion motion_;
  Pose2 T_odom_robot_;
  Motion granted_;
  double time_s_ = 0.0;
  int contacts_ = 0;
  bool runs_into_ = false;
  std::vector<double> free_range_m_;
  std::vector<double> unknown_ratio_;
  std::vector<double> obstacle_range_m_;
};

/// A scenario of the simulator by name.
simulator::Scene scenario_scene(const std::string& name);

}  // namespace roomwise::pilot
