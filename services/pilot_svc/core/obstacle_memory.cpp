#include "services/pilot_svc/core/obstacle_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roomwise::pilot {
namespace {

constexpr std::size_t kBinsMax = 1000;
constexpr std::size_t kEdgeBins = 3;
constexpr int kSightingsMax = 4;
constexpr int kSightingsBlocked = 2;
constexpr double kFloorNeeded_m = 0.25;     // less of it in view may not be noticed
constexpr double kNearestReading_m = 0.45;  // no Kinect measures nearer
constexpr double kFoot_m = 0.5;             // floor before a thing may not be told from it
constexpr double kNowhere_m = 1e3;

Duration to_duration(double time_s) { return Duration{static_cast<std::int64_t>(time_s * 1e6)}; }

Eigen::Vector2d on_ray(const Pose2& T_odom_robot, double bearing_rad, double range_m) {
  const double heading_rad = T_odom_robot.heading_rad + bearing_rad;
  return T_odom_robot.position_m() +
         range_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool is_view(const FreeView& view) {
  const std::size_t bins = view.free_range_m.size();
  return bins > 0 && bins <= kBinsMax && view.unknown_ratio.size() == bins &&
         view.obstacle_range_m.size() == bins && std::abs(view.first_bearing_rad) < 7.0 &&
         std::abs(view.bearing_step_rad) < 1.0 && all_finite(view.free_range_m) &&
         all_finite(view.unknown_ratio) && all_finite(view.obstacle_range_m);
}

/// First and last of the bins in view that are not at the view's edges.
std::pair<std::size_t, std::size_t> bins_well_in_view(const FreeView& view) {
  const auto is_in_view = [](double unknown) { return unknown < 1.0; };
  const auto& ratios = view.unknown_ratio;
  const auto first = std::find_if(ratios.begin(), ratios.end(), is_in_view);
  const auto last = std::find_if(ratios.rbegin(), ratios.rend(), is_in_view);
  const auto first_bin = static_cast<std::size_t>(first - ratios.begin());
  const auto bins_to_last = static_cast<std::size_t>(ratios.rend() - last);
  if (bins_to_last <= first_bin + 2 * kEdgeBins) return {1, 0};
  return {first_bin + kEdgeBins, bins_to_last - 1 - kEdgeBins};
}

/// Of `at` for the bin and its neighbours that are in view.
template <class At>
double median_m(const FreeView& view, std::size_t k, const At& at) {
  const bool has_left = k > 0 && view.unknown_ratio[k - 1] < 1.0;
  const bool has_right = k + 1 < view.free_range_m.size() && view.unknown_ratio[k + 1] < 1.0;
  if (!has_left || !has_right) return at(k);
  const double low_m = std::min(at(k - 1), at(k + 1));
  const double high_m = std::max(at(k - 1), at(k + 1));
  return std::clamp(at(k), low_m, high_m);
}

double free_m(const FreeView& view, std::size_t k) {
  return median_m(view, k, [&](std::size_t i) { return std::max(view.free_range_m[i], 0.0); });
}

/// To what is seen to stand along the bearing; far beyond all reach if nothing is.
double obstacle_m(const FreeView& view, std::size_t k) {
  return median_m(view, k, [&](std::size_t i) {
    return view.obstacle_range_m[i] > 0.0 ? view.obstacle_range_m[i] : kNowhere_m;
  });
}

}  // namespace

ObstacleMemory::ObstacleMemory(const PilotParams& params) : params_(params), cells_(capacity()) {}

void ObstacleMemory::forget() { std::fill(cells_.begin(), cells_.end(), Cell{}); }

bool ObstacleMemory::see(Time now, const Pose2& T_odom_robot, const FreeView& view) {
  if (!is_view(view)) return false;
  const auto [first, last] = bins_well_in_view(view);
  for (const bool is_end : {false, true}) {
    for (std::size_t k = 0; k < view.free_range_m.size(); ++k) {
      if (view.unknown_ratio[k] >= 1.0) continue;  // not in view
      const double bearing_rad =
          view.first_bearing_rad + static_cast<double>(k) * view.bearing_step_rad;
      const double way_m = free_m(view, k);
      if (!is_end) see_floor(now, T_odom_robot, bearing_rad, way_m);
      if (!is_end || k < first || k > last) continue;
      see_end(now, T_odom_robot, bearing_rad, way_m, obstacle_m(view, k));
    }
  }
  return true;
}

void ObstacleMemory::refuse(Time now, const Eigen::Vector2d& p_odom_m) {
  for (int sighting = 0; sighting < kSightingsBlocked; ++sighting) {
    set(now + Duration{sighting}, p_odom_m, true, params_.refusal_memory_s);
  }
}

void ObstacleMemory::see_floor(Time now, const Pose2& T_odom_robot, double bearing_rad,
                               double free_m) {
  const double free_to_m = std::min(free_m, params_.reach_m) - 0.5 * kCell_m;
  for (double r = params_.floor_seen_from_m; r < free_to_m; r += kCell_m) {
    set(now, on_ray(T_odom_robot, bearing_rad, r), false, params_.memory_s);
  }
}

void ObstacleMemory::see_end(Time now, const Pose2& T_odom_robot, double bearing_rad, double free_m,
                             double obstacle_m) {
  if (free_m >= params_.reach_m) return;
  const double floor_from_m = params_.floor_seen_from_m / std::cos(bearing_rad);
  const double seen_to_m = std::max(free_m, floor_from_m);
  if (obstacle_m < seen_to_m + kFoot_m) {
    // That it went away again would not be seen so near.
    const double for_s = obstacle_m < floor_from_m ? params_.near_memory_s : params_.memory_s;
    set(now, on_ray(T_odom_robot, bearing_rad, obstacle_m), true, for_s);
  } else if (free_m == 0.0) {
    guess(now, T_odom_robot, bearing_rad);
  } else {
    set(now, on_ray(T_odom_robot, bearing_rad, free_m + 0.5 * kCell_m), true, params_.memory_s);
  }
}

void ObstacleMemory::guess(Time now, const Pose2& T_odom_robot, double bearing_rad) {
  const double to_m = params_.floor_seen_from_m + kFloorNeeded_m;
  for (double r = 0.3; r < to_m; r += kCell_m) {
    if (is_blocked(now, on_ray(T_odom_robot, bearing_rad, r))) return;
  }
  const double range_m = 0.5 * (kNearestReading_m + params_.floor_seen_from_m);
  set(now, on_ray(T_odom_robot, bearing_rad, range_m), true, params_.guess_memory_s);
}

void ObstacleMemory::obstacles_round(Time now, const Pose2& T_odom_robot,
                                     std::vector<Eigen::Vector2d>& points_robot_m) const {
  points_robot_m.clear();
  const Pose2 T_robot_odom = inverse(T_odom_robot);
  const Eigen::Matrix2d R_robot_odom = rotation2(T_robot_odom.heading_rad);
  const double reach_sq_m2 = params_.reach_m * params_.reach_m;
  for (const Cell& cell : cells_) {
    if (cell.sightings < kSightingsBlocked || cell.fades < now) continue;
    const Eigen::Vector2d p_odom_m = kCell_m * Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5);
    const Eigen::Vector2d p_m = T_robot_odom.position_m() + R_robot_odom * p_odom_m;
    if (p_m.squaredNorm() < reach_sq_m2) points_robot_m.push_back(p_m);
  }
}

bool ObstacleMemory::is_known(Time now, const Eigen::Vector2d& p_odom_m) const {
  return find(now, place_of(p_odom_m)) != nullptr;
}

bool ObstacleMemory::is_blocked(Time now, const Eigen::Vector2d& p_odom_m) const {
  const Cell* cell = find(now, place_of(p_odom_m));
  return cell != nullptr && cell->sightings >= kSightingsBlocked;
}

ObstacleMemory::Place ObstacleMemory::place_of(const Eigen::Vector2d& p_odom_m) {
  const auto index = [](double at_m) {
    return static_cast<std::int32_t>(std::floor(std::clamp(at_m, -1e7, 1e7) / kCell_m));
  };
  return {index(p_odom_m.x()), index(p_odom_m.y())};
}

std::size_t ObstacleMemory::slot_of(const Place& place) {
  const auto wrapped = [](std::int32_t i) {
    return static_cast<std::size_t>((i % kSide + kSide) % kSide);
  };
  return wrapped(place.row) * kSide + wrapped(place.column);
}

const ObstacleMemory::Cell* ObstacleMemory::find(Time now, const Place& place) const {
  const Cell& cell = cells_[slot_of(place)];
  const bool is_it = cell.column == place.column && cell.row == place.row && cell.fades >= now;
  return is_it ? &cell : nullptr;
}

void ObstacleMemory::set(Time now, const Eigen::Vector2d& p_odom_m, bool is_blocked, double for_s) {
  const Place place = place_of(p_odom_m);
  Cell& cell = cells_[slot_of(place)];
  if (find(now, place) == nullptr) cell = Cell{place.column, place.row, 0, {}, {}, false};
  const bool is_same_frame = cell.seen == now;
  if (is_same_frame && (cell.seen_blocked || !is_blocked)) return;
  const int undone = is_same_frame ? 1 : 0;  // floor beside an end in one cell: the end counts
  cell.sightings = std::clamp(cell.sightings + (is_blocked ? 1 + undone : -1), 0, kSightingsMax);
  cell.fades = now + to_duration(for_s);
  cell.seen = now;
  cell.seen_blocked = is_blocked;
}

}  // namespace roomwise::pilot
