#include "services/landmark_svc/core/moving_mask.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr std::int64_t kApart_us = 100'000;
constexpr std::int64_t kStale_us = 5'000'000;
constexpr int kAgree = 2;  // earlier scans that must have seen through a place

}  // namespace

void MovingMask::clear() {
  known_ = 0;
  next_ = 0;
  moving_m_.clear();
}

bool MovingMask::was_free(const Past& past, const Eigen::Vector2d& p_odom_m,
                          const PinholeCamera& camera, const MovingParams& params) const {
  const Eigen::Vector2d from = p_odom_m - past.origin_m;
  const double along_m = from.dot(past.forward);
  const double left_m = past.forward.x() * from.y() - past.forward.y() * from.x();
  if (along_m < 0.3) return false;
  const double u = camera.cx_px - camera.fx_px * left_m / along_m;
  constexpr int kAside_px = 2;
  const auto width = static_cast<double>(past.along_m.size());
  if (!(u >= kAside_px && u < width - kAside_px - 1)) return false;
  const double free_m = along_m + params.margin_m + params.margin_ratio * along_m;
  const int column = static_cast<int>(std::lround(u));
  for (int k = -kAside_px; k <= kAside_px; ++k) {
    const float then_m = past.along_m[static_cast<std::size_t>(column + k)];
    const bool is_free = then_m > 0.0F ? then_m > free_m : along_m < params.unseen_free_m;
    if (!is_free) return false;
  }
  return true;
}

void MovingMask::reserve(int width_px) {
  const auto width = static_cast<std::size_t>(width_px);
  for (Past& past : past_) past.along_m.reserve(width);
  came_.reserve(width);
  moving_m_.reserve(width);
}

void MovingMask::remember(std::int64_t utime, const Pose2& T_odom_robot, const VirtualScan& scan,
                          int width_px) {
  Past& past = past_[next_];
  past.utime = utime;
  past.origin_m = transform(T_odom_robot, scan.origin_m());
  past.forward = rotation2(T_odom_robot.heading_rad) * scan.forward();
  past.along_m.assign(static_cast<std::size_t>(width_px), 0.0F);
  for (const ScanPoint& point : scan.points()) {
    past.along_m[static_cast<std::size_t>(point.u_px)] = static_cast<float>(point.along_m);
  }
  // Farther than anything good: seen through at least so far.
  for (const int u_px : scan.open_px()) {
    past.along_m[static_cast<std::size_t>(u_px)] = static_cast<float>(DisparityTable::kDepthMax_m);
  }
  next_ = (next_ + 1) % kScans;
  known_ = std::min(known_ + 1, kScans);
  newest_utime_ = utime;
}

void MovingMask::update(std::int64_t utime, const Pose2& T_odom_robot, const VirtualScan& scan,
                        const PinholeCamera& camera, int width_px, const MovingParams& params) {
  moving_m_.clear();
  if (known_ > 0 && (utime < newest_utime_ || utime > newest_utime_ + kStale_us)) clear();
  const auto& points = scan.points();
  came_.assign(points.size(), 0);
  const auto memory_us = static_cast<std::int64_t>(1e6 * params.memory_s);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p_odom_m = transform(T_odom_robot, points[i].p_robot_m);
    int agree = 0;
    for (std::size_t k = 0; k < known_ && agree < kAgree; ++k) {
      if (utime - past_[k].utime > memory_us) continue;
      agree += was_free(past_[k], p_odom_m, camera, params) ? 1 : 0;
    }
    came_[i] = agree >= kAgree ? 1 : 0;
  }
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    constexpr double kNeighbours_m = 0.15;
    while (end < points.size() && came_[end] == came_[begin] &&
           (points[end].p_robot_m - points[end - 1].p_robot_m).norm() < kNeighbours_m) {
      ++end;
    }
    const double width_m = (points[end - 1].p_robot_m - points[begin].p_robot_m).norm();
    if (came_[begin] != 0 && width_m >= params.width_min_m) {
      for (std::size_t i = begin; i < end; ++i) moving_m_.push_back(points[i].p_robot_m);
    }
    begin = end;
  }
  if (known_ == 0 || utime >= newest_utime_ + kApart_us) {
    remember(utime, T_odom_robot, scan, width_px);
  }
}

bool MovingMask::covers(const Eigen::Vector2d& p_robot_m, const MovingParams& params) const {
  return std::any_of(moving_m_.begin(), moving_m_.end(), [&](const Eigen::Vector2d& moving_m) {
    return (moving_m - p_robot_m).squaredNorm() < params.reach_m * params.reach_m;
  });
}

}  // namespace roomwise::landmark
