#include "services/pilot_svc/core/glance.h"

#include <cmath>

#include "services/pilot_svc/core/free_way.h"

namespace roomwise::pilot {
namespace {

constexpr double kInView_rad = 0.4;
constexpr double kFaces_rad = 0.1;
constexpr double kSamePlace_m = 0.15;
constexpr double kGlance_s = 6.0;     // safety_svc may not let it
constexpr double kMeasured_m = 0.55;  // nearer than this a Kinect may not measure what stands there
constexpr double kLine_m = 0.1;       // half of the width looked along

}  // namespace

void Glance::forget() {
  is_on_ = false;
  looked_at_odom_m_.reset();
}

bool Glance::was_looked_at(Time now, const Eigen::Vector2d& p_odom_m) const {
  return looked_at_odom_m_ && seconds(now - began_) < params_.refusal_memory_s &&
         (p_odom_m - *looked_at_odom_m_).norm() < kSamePlace_m;
}

bool Glance::begin(Time now, const Pose2& T_odom_robot, const Eigen::Vector2d& p_robot_m,
                   std::span<const Eigen::Vector2d> obstacles_robot_m) {
  const double bearing_rad = std::atan2(p_robot_m.y(), p_robot_m.x());
  const Eigen::Vector2d p_odom_m = transform(T_odom_robot, p_robot_m);
  if (std::abs(bearing_rad) < kInView_rad || was_looked_at(now, p_odom_m)) return false;
  const double view_m = swept_way_m(obstacles_robot_m, bearing_rad, kLine_m, params_.reach_m);
  if (view_m < kMeasured_m) return false;
  is_on_ = true;
  began_ = now;
  heading_rad_ = wrap_angle(T_odom_robot.heading_rad + bearing_rad);
  faces_since_.reset();
  looked_at_odom_m_ = p_odom_m;
  return true;
}

Motion Glance::step(Time now, const Pose2& T_odom_robot) {
  const double off_rad = wrap_angle(heading_rad_ - T_odom_robot.heading_rad);
  if (!faces_since_ && std::abs(off_rad) < kFaces_rad) faces_since_ = now;
  const bool has_seen = faces_since_ && seconds(now - *faces_since_) >= params_.look_s;
  if (has_seen || seconds(now - began_) > kGlance_s) is_on_ = false;
  return steer(off_rad, 0.0, 0.0, params_);
}

}  // namespace roomwise::pilot
