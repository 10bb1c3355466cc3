#pragma once
#include <optional>
#include <span>

#include "services/pilot_svc/core/steering.h"
#include "services/pilot_svc/core/surroundings.h"

namespace roomwise::pilot {

/// Turns the camera to a place safety_svc does not let the robot go to. Mostly that is a place
/// beside it which nobody has seen yet: once seen it may be let go there.
class Glance {
 public:
  explicit Glance(const PilotParams& params) : params_(params) {}

  /// False, and nothing begun, if the place (robot frame) is in view anyway or was looked at
  /// lately, or if something stands so near behind it that it is not measured: nothing would become
  /// known, and what was known is doubted then.
  [[nodiscard]] bool begin(Time now, const Pose2& T_odom_robot, const Eigen::Vector2d& p_robot_m,
                           std::span<const Eigen::Vector2d> obstacles_robot_m);
  bool is_on() const { return is_on_; }
  void forget();
  Motion step(Time now, const Pose2& T_odom_robot);

 private:
  bool was_looked_at(Time now, const Eigen::Vector2d& p_odom_m) const;

  PilotParams params_;
  bool is_on_ = false;
  Time began_{};
  double heading_rad_ = 0.0;  // to turn to, odom frame
  std::optional<Time> faces_since_;
  std::optional<Eigen::Vector2d> looked_at_odom_m_;
};

}  // namespace roomwise::pilot
