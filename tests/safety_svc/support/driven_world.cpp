#include "tests/safety_svc/support/driven_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise::safety {
namespace {

constexpr int kBins = 91;
constexpr int kHalfView = 28;
constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kSight_m = 5.0;

}  // namespace

DrivenWorld::DrivenWorld() : free_m_(kBins), unknown_(kBins, 1.0), obstacle_m_(kBins) {
  params.floor_seen_from_m = kSeenFrom_m;
  world = World(params);
}

CameraSetup DrivenWorld::camera() {
  // Looks along robot x: camera z, x, y are robot x, -y, -z. Lowest row 29 degrees down.
  return {.p_robot_camera_m = {0.0, 0.0, 0.4},
          .quat_wxyz = {0.5, -0.5, 0.5, -0.5},
          .fy_px = 430.0,
          .cy_px = 240.0,
          .height_px = 480};
}

double DrivenWorld::sight_m(double bearing_rad) const {
  const double heading_rad = T_odom_robot.heading_rad + bearing_rad;
  const Eigen::Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
  double nearest_m = kSight_m;
  for (const Disc& disc : discs) {
    const Eigen::Vector2d to = disc.p_m - T_odom_robot.position_m();
    const double along_m = to.dot(direction);
    const double across_sq = to.squaredNorm() - along_m * along_m;
    const double rest_sq = disc.radius_m * disc.radius_m - across_sq;
    if (along_m > 0.0 && rest_sq > 0.0) {
      nearest_m = std::min(nearest_m, along_m - std::sqrt(rest_sq));
    }
  }
  return nearest_m;
}

FloorView DrivenWorld::view() const {
  FloorView seen;
  seen.time = now_.wall + stamp_ahead;
  seen.is_plane_trusted = true;
  seen.floor_normal = {0.0, -1.0, 0.0};
  seen.floor_height_m = 0.4;
  seen.free = {.first_bearing_rad = -45 * kDegree_rad,
               .bearing_step_rad = kDegree_rad,
               .free_range_m = free_m_,
               .unknown_ratio = unknown_,
               .obstacle_range_m = obstacle_m_};
  return seen;
}

OdometrySample DrivenWorld::odometry_sample() const {
  return {.time = now_.wall + stamp_ahead,
          .interval = kTick,
          .distance_m = moved_.speed_mps * seconds(kTick),
          .turn_rad = moved_.turn_rate_radps * seconds(kTick),
          .T_odom_robot = T_odom_robot,
          .reset_counter = odometry_resets};
}

void DrivenWorld::hear() {
  // What is refused is refused on purpose: the tests look at the decisions.
  if (has_odometry) (void)world.hear_odometry(now_, odometry_sample());
  if (has_body) (void)world.hear_body(now_, now_.wall + stamp_ahead, body);
  if (has_camera && ticks_ % 2 == 0) {
    for (int bin = 0; bin < kBins; ++bin) {
      const int degrees = bin - kBins / 2;
      const auto index = static_cast<std::size_t>(bin);
      const bool is_in_view = std::abs(degrees) <= kHalfView;
      free_m_[index] = obstacle_m_[index] = 0.0;
      unknown_[index] = 1.0;
      if (!is_in_view || clearance_m() < dark_within_m) continue;
      const double bearing_rad = degrees * kDegree_rad;
      const double nearest_m = sight_m(bearing_rad);
      if (nearest_m >= kSeenFrom_m / std::cos(bearing_rad)) free_m_[index] = nearest_m;
      if (nearest_m < kSight_m && nearest_m > kNearestReading_m) obstacle_m_[index] = nearest_m;
      unknown_[index] = 0.1;
    }
    if (has_frames) (void)world.hear_frame(now_, now_.wall + stamp_ahead, camera());
    (void)world.hear_view(now_, view());
  }
  if (asks) hear_request();
}

void DrivenWorld::hear_request() {
  (void)world.requests.hear(now_, {.request = request,
                                   .source = "test",
                                   .priority = 10,
                                   .valid_for = std::chrono::milliseconds(100),
                                   .decided = now_.wall});
}

Decision DrivenWorld::step() {
  now_.steady += kTick;
  now_.wall += kTick;
  hear();
  world.tick(now_);
  const Decision decision = decide(now_, world, granted, params);
  granted = {decision.granted, now_.steady};
  moved_ = decision.granted;
  const double half_rad = 0.5 * moved_.turn_rate_radps * seconds(kTick);
  const double way_m = moved_.speed_mps * seconds(kTick);
  T_odom_robot = compose(T_odom_robot,
                         {way_m * std::cos(half_rad), way_m * std::sin(half_rad), 2.0 * half_rad});
  ++ticks_;
  return decision;
}

Decision DrivenWorld::run(Duration time) {
  Decision last;
  for (Duration gone{}; gone < time; gone += kTick) last = step();
  return last;
}

double DrivenWorld::clearance_m() const {
  double nearest_m = 100.0;
  for (const Disc& disc : discs) {
    nearest_m = std::min(nearest_m, (disc.p_m - T_odom_robot.position_m()).norm() - disc.radius_m -
                                        params.robot_radius_m);
  }
  return nearest_m;
}

}  // namespace roomwise::safety
