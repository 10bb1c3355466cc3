#include "services/safety_svc/core/obstacle_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {
namespace {

constexpr std::int32_t kSide = 128;  // cells; a power of two
constexpr double kStep_m = 0.025;    // along a bearing: half a cell
constexpr double kTouched_m = 0.10;  // thickness of what was felt
constexpr double kTouched_rad = 1.05;
constexpr double kTouchedStep_rad = 0.1;
constexpr std::size_t kBinsMax = 1000;
/// The shadow a Kinect's projector, 7.5 cm beside its camera, leaves behind the edge of something
/// 0.5 m off. Darkness as narrow as this need not be something too near to be measured.
constexpr double kShadow_rad = 0.15;
constexpr std::size_t kEdgeBins = 3;     // at the view's edges, where pixels come and go
constexpr double kBearingMax_rad = 1.5;  // farther to the side no camera that looks ahead sees

std::int32_t cell_index(double p_m) {
  return static_cast<std::int32_t>(std::floor(p_m / ObstacleMemory::kCell_m));
}

bool is_view(const FreeView& view) {
  const std::size_t bins = view.free_range_m.size();
  if (bins == 0 || bins > kBinsMax || view.unknown_ratio.size() != bins ||
      view.obstacle_range_m.size() != bins) {
    return false;
  }
  const double last_rad =
      view.first_bearing_rad + view.bearing_step_rad * static_cast<double>(bins - 1);
  if (!(std::abs(view.first_bearing_rad) < kBearingMax_rad) ||
      !(std::abs(last_rad) < kBearingMax_rad)) {
    return false;
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return std::all_of(view.free_range_m.begin(), view.free_range_m.end(), is_finite) &&
         std::all_of(view.unknown_ratio.begin(), view.unknown_ratio.end(), is_finite) &&
         std::all_of(view.obstacle_range_m.begin(), view.obstacle_range_m.end(), is_finite);
}

bool is_in_view(double unknown_ratio) { return unknown_ratio < 1.0; }

bool is_unread(double unknown_ratio) { return unknown_ratio > kUnknownRatio; }

std::size_t first_in_view(const FreeView& view) {
  const auto& ratios = view.unknown_ratio;
  return static_cast<std::size_t>(std::find_if(ratios.begin(), ratios.end(), is_in_view) -
                                  ratios.begin());
}

/// 0 as well if none is.
std::size_t last_in_view(const FreeView& view) {
  const auto& ratios = view.unknown_ratio;
  const auto last = std::find_if(ratios.rbegin(), ratios.rend(), is_in_view);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(ratios.rend() - last - 1, 0));
}

/// What a place is after `age`.
Ground faded(Ground ground, Duration age) {
  if (ground == Ground::kFree) return age <= kFreeLife ? Ground::kFree : Ground::kOverlooked;
  if (ground == Ground::kClosed) return age <= kClosedLife ? Ground::kClosed : Ground::kUnknown;
  return ground;
}

}  // namespace

/// One bearing of a view, from the robot's centre.
struct ObstacleMemory::Ray {
  Eigen::Vector2d p_odom_m;
  Eigen::Vector2d direction;  // unit length
  double free_m = 0.0;
  double seen_from_m = 0.0;
  double own_m = 0.0;
  double obstacle_m = 0.0;  // 0: none seen
  bool is_dark = false;
  Reason end = Reason::kObstacle;

  bool sees_floor() const { return free_m > seen_from_m; }
  /// Near enough to be why no floor comes into view; an edge to fall off hides none.
  bool sees_obstacle() const {
    // either bound: a place is known to a cell.
    return obstacle_m < seen_from_m + 2.0 * kCell_m && obstacle_m > 0.0 && !is_dark &&
           end != Reason::kDropOff;
  }
  /// Where the floor did not come into view: what may stand there stands between these.
  double doubtful_from_m() const {
    if (is_dark) return own_m + kCell_m;
    return sees_obstacle() ? obstacle_m - kCell_m : kNearestReading_m;
  }
  double doubtful_to_m() const { return is_dark ? kReach_m : seen_from_m + 2.0 * kCell_m; }
  /// What explains the view is no farther: in the dark it is too near to be measured.
  double explained_within_m() const {
    return (is_dark ? kNearestReading_m : seen_from_m) + 2.0 * kCell_m;
  }
  Eigen::Vector2d at(double range_m) const { return p_odom_m + range_m * direction; }
};

ObstacleMemory::ObstacleMemory()
    : cells_(static_cast<std::size_t>(kSide) * kSide),
      was_in_view_(kBinsMax + 2 * kEdgeBins, false) {}

void ObstacleMemory::forget() { std::fill(cells_.begin(), cells_.end(), Cell{}); }

bool ObstacleMemory::see(const Instant& now, const Pose2& T_odom_robot, const FreeView& view,
                         double own_m) {
  if (!is_view(view)) return false;
  const auto ray_of = [&](std::size_t bin) {
    const double bearing_rad =
        view.first_bearing_rad + view.bearing_step_rad * static_cast<double>(bin);
    const double heading_rad = T_odom_robot.heading_rad + bearing_rad;
    const bool is_dark = is_unread(view.unknown_ratio[bin]);
    const Eigen::Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
    return Ray{.p_odom_m = T_odom_robot.position_m(),
               .direction = direction,
               .free_m = std::clamp(view.free_range_m[bin], 0.0, kReach_m),
               .seen_from_m = view.floor_seen_from_m / std::cos(bearing_rad),
               .own_m = own_m,
               .obstacle_m = view.obstacle_range_m[bin],
               // either bound: no shadow is known to a bit.
               .is_dark = is_dark && dark_round_rad(view, bin) >= kShadow_rad,
               .end = view.has_drop_off ? Reason::kDropOff
                      : is_dark         ? Reason::kUnknown
                                        : Reason::kObstacle};
  };
  const std::size_t bins = view.free_range_m.size();
  for (std::size_t bin = 0; bin != bins; ++bin) {
    if (is_in_view(view.unknown_ratio[bin])) was_in_view_.at(kEdgeBins + bin) = true;
  }
  for (std::size_t bin = 0; bin != bins; ++bin) {
    const Ray ray = ray_of(bin);
    if (ray.sees_floor()) open(now, ray);
    if (!ray.sees_floor() && is_well_in_view(bin)) doubt(now, ray);
  }
  // Afterwards, so that no neighbour opens what this one saw to end. At the view's edges bearings
  // are in view in part: what seems to end there is in the middle of a view that matters.
  for (std::size_t bin = first_in_view(view) + kEdgeBins; bin + kEdgeBins <= last_in_view(view);
       ++bin) {
    const Ray ray = ray_of(bin);
    if (ray.sees_floor()) close_end(now, ray);
  }
  return true;
}

bool ObstacleMemory::is_well_in_view(std::size_t bin) const {
  const auto first = was_in_view_.begin() + static_cast<std::ptrdiff_t>(bin);
  return std::all_of(first, first + 2 * kEdgeBins + 1, [](bool was) { return was; });
}

double ObstacleMemory::dark_round_rad(const FreeView& view, std::size_t bin) const {
  const auto is_dark = [&](std::size_t k) {
    return was_in_view_[kEdgeBins + k] && is_unread(view.unknown_ratio[k]);
  };
  std::size_t first = bin;
  while (first != 0 && is_dark(first - 1)) --first;
  std::size_t end = bin;
  while (end != view.unknown_ratio.size() && is_dark(end)) ++end;
  return static_cast<double>(end - first) * std::abs(view.bearing_step_rad);
}

void ObstacleMemory::open(const Instant& now, const Ray& ray) {
  // either bound: steps are half a cell, and the cell at the end is closed.
  for (double range_m = 0.0; range_m < ray.free_m; range_m += kStep_m) {
    const Eigen::Vector2d p_odom_m = ray.at(range_m);
    // either bound: steps are half a cell.
    if (range_m >= ray.seen_from_m) {
      set(now, p_odom_m, Ground::kFree, Reason::kAsAsked);
    } else {
      overlook(now, p_odom_m);
    }
  }
}

void ObstacleMemory::overlook(const Instant& now, const Eigen::Vector2d& p_odom_m) {
  if (at(now, p_odom_m).ground != Ground::kUnknown) return;
  set(now, p_odom_m, Ground::kOverlooked, Reason::kAsAsked);
}

void ObstacleMemory::doubt(const Instant& now, const Ray& ray) {
  // either bound: steps are half a cell.
  for (double range_m = 0.0; ray.sees_obstacle() && range_m < ray.doubtful_from_m();
       range_m += kStep_m) {
    overlook(now, ray.at(range_m));
  }
  const double explained_to_m = closed_at_m(now, ray);
  // either bound: steps are half a cell.
  for (double range_m = ray.doubtful_from_m(); range_m < ray.doubtful_to_m(); range_m += kStep_m) {
    const Eigen::Vector2d p_odom_m = ray.at(range_m);
    const Ground ground = at(now, p_odom_m).ground;
    if (ground == Ground::kClosed) continue;
    // either bound: what is closed at its end was left as it is above.
    const bool is_explained = ground != Ground::kUnknown && range_m < explained_to_m;
    set(now, p_odom_m, is_explained ? Ground::kOverlooked : Ground::kUnknown, Reason::kUnknown);
  }
}

double ObstacleMemory::closed_at_m(const Instant& now, const Ray& ray) const {
  // either bound: steps are half a cell.
  for (double range_m = ray.doubtful_from_m(); range_m < ray.explained_within_m();
       range_m += kStep_m) {
    if (at(now, ray.at(range_m)).ground == Ground::kClosed) return range_m;
  }
  return 0.0;
}

void ObstacleMemory::close_end(const Instant& now, const Ray& ray) {
  if (ray.free_m >= kReach_m) return;
  set(now, ray.at(ray.free_m), Ground::kClosed, ray.end);
  set(now, ray.at(ray.free_m + kCell_m), Ground::kClosed, ray.end);
}

void ObstacleMemory::overlook_round(const Instant& now, const Pose2& T_odom_robot,
                                    double radius_m) {
  // either bound: steps are half a cell.
  for (double x_m = -radius_m; x_m <= radius_m; x_m += kStep_m) {
    // either bound: as above.
    for (double y_m = -radius_m; y_m <= radius_m; y_m += kStep_m) {
      // equivalent: a circle is its own mirror image.
      const Eigen::Vector2d p_odom_m = T_odom_robot.position_m() + Eigen::Vector2d(x_m, y_m);
      // either bound: as above.
      if (std::hypot(x_m, y_m) <= radius_m) overlook(now, p_odom_m);
    }
  }
}

void ObstacleMemory::touch(const Instant& now, const Pose2& T_odom_robot, double radius_m,
                           Reason why) {
  // either bound: steps are half a cell where the bumper is.
  for (double bearing_rad = -kTouched_rad; bearing_rad <= kTouched_rad;
       bearing_rad += kTouchedStep_rad) {
    // equivalent: a robot's front is its own mirror image.
    const double heading_rad = T_odom_robot.heading_rad + bearing_rad;
    const Eigen::Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
    for (double deep_m = kCell_m; deep_m <= kTouched_m; deep_m += kStep_m) {
      set(now, T_odom_robot.position_m() + (radius_m + deep_m) * direction, Ground::kClosed, why);
    }
  }
}

Place ObstacleMemory::at(const Instant& now, const Eigen::Vector2d& p_odom_m) const {
  const std::int32_t column = cell_index(p_odom_m.x());
  const std::int32_t row = cell_index(p_odom_m.y());
  const Cell& cell = cell_of(column, row);
  if (cell.column != column || cell.row != row) return {};
  const Duration age = now.steady - cell.seen;
  const Ground ground = faded(cell.ground, age);
  if (ground != Ground::kClosed) return {.ground = ground};
  const bool is_seen_now = cell.why != Reason::kObstacle || age <= kCameraAge;
  return {.ground = ground, .why = is_seen_now ? cell.why : Reason::kRemembered};
}

void ObstacleMemory::set(const Instant& now, const Eigen::Vector2d& p_odom_m, Ground ground,
                         Reason why) {
  const std::int32_t column = cell_index(p_odom_m.x());
  const std::int32_t row = cell_index(p_odom_m.y());
  cell_of(column, row) = {column, row, ground, why, now.steady};
}

ObstacleMemory::Cell& ObstacleMemory::cell_of(std::int32_t column, std::int32_t row) {
  constexpr std::int32_t kMask = kSide - 1;
  return cells_[static_cast<std::size_t>((row & kMask) * kSide + (column & kMask))];
}

const ObstacleMemory::Cell& ObstacleMemory::cell_of(std::int32_t column, std::int32_t row) const {
  return const_cast<ObstacleMemory*>(this)->cell_of(column, row);
}

}  // namespace roomwise::safety
