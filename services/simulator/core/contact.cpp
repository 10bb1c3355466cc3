#include "services/simulator/core/contact.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace roomwise::simulator {
namespace {

using Eigen::Vector2d;

/// Overlaps smaller than this are rounding.
constexpr double kOverlap_m = 1e-9;
/// Corners are solved by pushing out of one side after the other; this many times at most.
constexpr int kPushes = 12;
/// A moving disc pushes the robot at most this far at once; less than its radius, so that it cannot
/// come out on the far side of a wall.
constexpr double kLongestPush_m = 0.05;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2d nearest_point(const PlanWall& wall, const Vector2d& point_m) {
  const Vector2d along = wall.b_m - wall.a_m;
  const double length2 = along.squaredNorm();
  if (length2 == 0.0) return wall.a_m;
  const double share = std::clamp((point_m - wall.a_m).dot(along) / length2, 0.0, 1.0);
  return wall.a_m + share * along;
}

/// Unit vector; x where there is no direction.
Vector2d direction_of(const Vector2d& v) {
  const double length = v.norm();
  return length > 0.0 ? Vector2d(v / length) : Vector2d(1.0, 0.0);
}

Touch touch_of(const PlanWall& wall, const Vector2d& center_m, double radius_m) {
  const Vector2d to_wall = nearest_point(wall, center_m) - center_m;
  return {direction_of(to_wall), to_wall.norm() - radius_m};
}

Touch touch_of(const PlanDisc& disc, const Vector2d& center_m, double radius_m) {
  const Vector2d to_disc = disc.center_m - center_m;
  return {direction_of(to_disc), to_disc.norm() - radius_m - disc.radius_m};
}

template <class Bodies>
void keep_deepest(const Bodies& bodies, const Vector2d& center_m, double radius_m, Touch& deepest) {
  for (const auto& body : bodies) {
    const Touch touch = touch_of(body, center_m, radius_m);
    if (touch.gap_m < deepest.gap_m) deepest = touch;
  }
}

Touch deepest_in_walls(const GroundPlan& plan, const Vector2d& center_m, double radius_m) {
  Touch deepest{{1.0, 0.0}, std::numeric_limits<double>::infinity()};
  keep_deepest(plan.walls, center_m, radius_m, deepest);
  return deepest;
}

Touch deepest_in_all(const GroundPlan& plan, const Vector2d& center_m, double radius_m) {
  Touch deepest = deepest_in_walls(plan, center_m, radius_m);
  keep_deepest(plan.discs, center_m, radius_m, deepest);
  return deepest;
}

template <class Deepest>
bool push_out(Deepest deepest, Vector2d& center_m) {
  for (int i = 0; i < kPushes; ++i) {
    const Touch touch = deepest(center_m);
    if (touch.gap_m >= -kOverlap_m) return true;
    center_m += touch.gap_m * touch.direction;
  }
  return false;
}

/// Way along the ray to the wall; infinite if it misses.
double way_to(const PlanWall& wall, const Vector2d& origin_m, const Vector2d& direction) {
  const Vector2d along = wall.b_m - wall.a_m;
  const double steepness = cross(direction, along);
  if (steepness == 0.0) return std::numeric_limits<double>::infinity();
  const Vector2d to_wall = wall.a_m - origin_m;
  const double way_m = cross(to_wall, along) / steepness;
  const double share = cross(to_wall, direction) / steepness;
  const bool meets = way_m >= 0.0 && share >= 0.0 && share <= 1.0;
  return meets ? way_m : std::numeric_limits<double>::infinity();
}

double way_to(const PlanDisc& disc, const Vector2d& origin_m, const Vector2d& direction) {
  const Vector2d to_center = disc.center_m - origin_m;
  const double along_m = to_center.dot(direction);
  const double aside_m = cross(direction, to_center);
  const double half2 = disc.radius_m * disc.radius_m - aside_m * aside_m;
  if (half2 < 0.0 || along_m < 0.0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, along_m - std::sqrt(half2));
}

bool inside(const PlanHole& hole, const Vector2d& point_m) {
  const std::size_t n = hole.corners_m.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d& a = hole.corners_m[i];
    if (cross(hole.corners_m[(i + 1) % n] - a, point_m - a) < 0.0) return false;
  }
  return n >= 3;
}

/// Whether a circle round all corners comes within reach of the point.
bool is_near(const PlanHole& hole, const Vector2d& point_m, double reach_m) {
  if (hole.corners_m.empty()) return false;
  double extent_m = 0.0;
  for (const Vector2d& corner : hole.corners_m) {
    extent_m = std::max(extent_m, (corner - hole.corners_m[0]).norm());
  }
  return (hole.corners_m[0] - point_m).norm() <= extent_m + reach_m;
}

}  // namespace

Vector2d slide_to(const GroundPlan& plan, const Vector2d& from_m, const Vector2d& wanted_m,
                  double radius_m) {
  const auto in_all = [&](const Vector2d& c) { return deepest_in_all(plan, c, radius_m); };
  const auto in_walls = [&](const Vector2d& c) { return deepest_in_walls(plan, c, radius_m); };
  const double longest_m = (wanted_m - from_m).norm() + kLongestPush_m;
  Vector2d center_m = wanted_m;
  if (push_out(in_all, center_m) && (center_m - from_m).norm() <= longest_m) return center_m;
  const bool overrun = in_all(from_m).gap_m < -kOverlap_m;
  center_m = wanted_m;
  if (overrun && push_out(in_walls, center_m)) return center_m;
  return from_m;
}

void find_touches(const GroundPlan& plan, const Vector2d& center_m, double radius_m, double reach_m,
                  std::vector<Touch>& touches) {
  touches.clear();
  const auto add = [&](const auto& body) {
    const Touch touch = touch_of(body, center_m, radius_m);
    if (touch.gap_m <= reach_m) touches.push_back(touch);
  };
  std::for_each(plan.walls.begin(), plan.walls.end(), add);
  std::for_each(plan.discs.begin(), plan.discs.end(), add);
}

double free_way_m(const GroundPlan& plan, const Vector2d& origin_m, const Vector2d& direction,
                  double longest_m) {
  double way_m = longest_m;
  for (const PlanWall& wall : plan.walls) {
    way_m = std::min(way_m, way_to(wall, origin_m, direction));
  }
  for (const PlanDisc& disc : plan.discs) {
    way_m = std::min(way_m, way_to(disc, origin_m, direction));
  }
  return way_m;
}

bool over_hole(const GroundPlan& plan, const Vector2d& point_m) {
  return std::any_of(plan.holes.begin(), plan.holes.end(),
                     [&](const PlanHole& hole) { return inside(hole, point_m); });
}

void keep_near(const GroundPlan& plan, const Vector2d& point_m, double reach_m, GroundPlan& near) {
  const auto gap_to = [&](const auto& body) { return touch_of(body, point_m, 0.0).gap_m; };
  const auto in_reach = [&](const auto& body) { return gap_to(body) <= reach_m; };
  near.walls.clear();
  near.discs.clear();
  near.holes.clear();
  std::copy_if(plan.walls.begin(), plan.walls.end(), std::back_inserter(near.walls), in_reach);
  std::copy_if(plan.discs.begin(), plan.discs.end(), std::back_inserter(near.discs), in_reach);
  std::copy_if(plan.holes.begin(), plan.holes.end(), std::back_inserter(near.holes),
               [&](const PlanHole& hole) { return is_near(hole, point_m, reach_m); });
}

}  // namespace roomwise::simulator
