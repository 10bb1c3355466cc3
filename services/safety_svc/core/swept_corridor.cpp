#include "services/safety_svc/core/swept_corridor.h"

#include <algorithm>
#include <cmath>

#include "services/safety_svc/core/arc.h"

namespace roomwise::safety {
namespace {

constexpr double kSweepStep_m = 0.025;
constexpr double kCell_m = ObstacleMemory::kCell_m;
constexpr double kHalfCell_m = 0.5 * kCell_m;

/// Of the first cell from `p_m` on.
double first_centre_m(double p_m) {
  const double corner_m = std::floor(p_m / kCell_m) * kCell_m;
  // equivalent: a cell earlier begins out of reach, where no place counts.
  return corner_m + kHalfCell_m;
}

/// The corridor's places, position by position of the robot.
class Sweep {
 public:
  Sweep(const Instant& now, const ObstacleMemory& memory, const Pose2& T_odom_robot,
        const SafetyParams& params)
      : now_(now),
        memory_(memory),
        T_odom_robot_(T_odom_robot),
        own_m_(params.robot_radius_m),
        reach_m_(params.robot_radius_m + params.margin_m) {}

  /// Looks at every place the disc covers from `pose_odom`. False if one is not to be entered.
  bool enter(const Pose2& pose_odom, CorridorView& view) {
    is_overlooked_ = false;
    const Eigen::Vector2d centre = pose_odom.position_m();
    // either bound: what lies as far off as the robot reaches is not met.
    for (double x = first_centre_m(centre.x() - reach_m_); x <= centre.x() + reach_m_;
         x += kCell_m) {
      // either bound: as above.
      for (double y = first_centre_m(centre.y() - reach_m_); y <= centre.y() + reach_m_;
           y += kCell_m) {
        if (is_ahead({x, y}, centre) && !look({x, y}, view)) return false;
      }
    }
    return true;
  }
  bool is_overlooked() const { return is_overlooked_; }
  double unknown_ratio() const { return looked_ == 0 ? 0.0 : static_cast<double>(dim_) / looked_; }

 private:
  bool is_ahead(const Eigen::Vector2d& place, const Eigen::Vector2d& centre) const {
    const double then_m = (place - centre).norm();
    const double now_m = (place - T_odom_robot_.position_m()).norm();
    // either bound: a place is known to half a cell.
    return then_m < reach_m_ && now_m > own_m_ && then_m < now_m;
  }

  bool look(const Eigen::Vector2d& place, CorridorView& view) {
    const Place found = memory_.at(now_, place);
    ++looked_;
    dim_ += found.ground == Ground::kFree ? 0 : 1;
    if (found.ground == Ground::kOverlooked) is_overlooked_ = true;
    if (found.ground == Ground::kFree || found.ground == Ground::kOverlooked) return true;
    view.end = found.why;
    view.p_robot_end_m = transform(inverse(T_odom_robot_), place);
    return false;
  }

  const Instant& now_;
  const ObstacleMemory& memory_;
  const Pose2& T_odom_robot_;
  double own_m_;
  double reach_m_;
  bool is_overlooked_ = false;
  int looked_ = 0;
  int dim_ = 0;
};

}  // namespace

CorridorView sweep(const Instant& now, const ObstacleMemory& memory, const Pose2& T_odom_robot,
                   double curvature_radpm, double length_m, const SafetyParams& params) {
  CorridorView view;
  Sweep sweep(now, memory, T_odom_robot, params);
  const double end_m = std::min(length_m, ObstacleMemory::kReach_m);
  bool is_known = true;
  while (view.free_m < end_m) {
    const double next_m = view.free_m + kSweepStep_m;
    const Pose2 pose = compose(T_odom_robot, along_arc(next_m, curvature_radpm));
    if (!sweep.enter(pose, view)) break;
    is_known = is_known && !sweep.is_overlooked();
    if (is_known) view.known_m = next_m;
    view.free_m = next_m;
  }
  view.unknown_ratio = sweep.unknown_ratio();
  return view;
}

}  // namespace roomwise::safety
