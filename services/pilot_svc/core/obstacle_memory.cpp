#include "services/pilot_svc/core/obstacle_memory.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {
namespace {

constexpr std::size_t kBinsMax = 1000;
constexpr double kNearestReading_m = 0.45;  // no Kinect measures nearer

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
         std::abs(view.first_bearing_rad) < 7.0 && std::abs(view.bearing_step_rad) < 1.0 &&
         all_finite(view.free_range_m) && all_finite(view.unknown_ratio);
}

}  // namespace

ObstacleMemory::ObstacleMemory(const PilotParams& params) : params_(params), cells_(capacity()) {}

void ObstacleMemory::forget() { std::fill(cells_.begin(), cells_.end(), Cell{}); }

bool ObstacleMemory::see(Time now, const Pose2& T_odom_robot, const FreeView& view) {
  if (!is_view(view)) return false;
  for (std::size_t k = 0; k < view.free_range_m.size(); ++k) {
    if (view.unknown_ratio[k] >= 1.0) continue;  // not in view
    const double bearing_rad =
        view.first_bearing_rad + static_cast<double>(k) * view.bearing_step_rad;
    const double free_m = std::max(view.free_range_m[k], 0.0);
    if (free_m > 0.0) see_ray(now, T_odom_robot, bearing_rad, free_m);
    if (free_m == 0.0) guess(now, T_odom_robot, bearing_rad);
  }
  return true;
}

void ObstacleMemory::see_ray(Time now, const Pose2& T_odom_robot, double bearing_rad,
                             double free_m) {
  const Time fades = now + to_duration(params_.memory_s);
  const double free_to_m = std::min(free_m, params_.reach_m);
  for (double r = params_.floor_seen_from_m; r < free_to_m - 0.5 * kCell_m; r += kCell_m) {
    set(on_ray(T_odom_robot, bearing_rad, r), false, fades);
  }
  if (free_m >= params_.reach_m) return;
  set(on_ray(T_odom_robot, bearing_rad, free_m + 0.5 * kCell_m), true, fades);
}

void ObstacleMemory::guess(Time now, const Pose2& T_odom_robot, double bearing_rad) {
  const double to_m = params_.floor_seen_from_m + 2.0 * kCell_m;
  for (double r = 0.3; r < to_m; r += kCell_m) {
    if (is_blocked(now, on_ray(T_odom_robot, bearing_rad, r))) return;
  }
  const double range_m = 0.5 * (kNearestReading_m + params_.floor_seen_from_m);
  set(on_ray(T_odom_robot, bearing_rad, range_m), true, now + to_duration(params_.guess_memory_s));
}

void ObstacleMemory::obstacles_round(Time now, const Pose2& T_odom_robot,
                                     std::vector<Eigen::Vector2d>& points_robot_m) const {
  points_robot_m.clear();
  const Pose2 T_robot_odom = inverse(T_odom_robot);
  const Eigen::Matrix2d R_robot_odom = rotation2(T_robot_odom.heading_rad);
  const double reach_sq_m2 = params_.reach_m * params_.reach_m;
  for (const Cell& cell : cells_) {
    if (!cell.is_blocked || cell.fades < now) continue;
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
  return cell != nullptr && cell->is_blocked;
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

void ObstacleMemory::set(const Eigen::Vector2d& p_odom_m, bool is_blocked, Time fades) {
  const Place place = place_of(p_odom_m);
  cells_[slot_of(place)] = {place.column, place.row, is_blocked, fades};
}

}  // namespace roomwise::pilot
