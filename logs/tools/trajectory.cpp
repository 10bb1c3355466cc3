#include "logs/tools/trajectory.h"

#include <algorithm>

namespace roomwise {
namespace {

constexpr std::int64_t kLongestGap_us = 1000000;

Pose2 between(const TimedPose2& before, const TimedPose2& after, std::int64_t utime) {
  const double ratio =
      static_cast<double>(utime - before.utime) / static_cast<double>(after.utime - before.utime);
  const Pose2& a = before.pose;
  const Pose2& b = after.pose;
  const double turn_rad = wrap_angle(b.heading_rad - a.heading_rad);
  return {a.x_m + ratio * (b.x_m - a.x_m), a.y_m + ratio * (b.y_m - a.y_m),
          wrap_angle(a.heading_rad + ratio * turn_rad)};
}

}  // namespace

std::optional<Pose2> pose_at(const Trajectory& trajectory, std::int64_t utime) {
  const auto after = std::ranges::lower_bound(trajectory, utime, {}, &TimedPose2::utime);
  if (after == trajectory.end()) return std::nullopt;
  if (after->utime == utime) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->utime - before->utime > kLongestGap_us) return std::nullopt;
  return between(*before, *after, utime);
}

Trajectory first_after(const Trajectory& trajectory, std::span<const std::int64_t> utimes) {
  Trajectory chosen;
  auto next = trajectory.begin();
  for (const std::int64_t utime : utimes) {
    next = std::ranges::lower_bound(next, trajectory.end(), utime, {}, &TimedPose2::utime);
    if (next == trajectory.end()) break;
    if (chosen.empty() || chosen.back().utime != next->utime) chosen.push_back(*next);
  }
  return chosen;
}

}  // namespace roomwise
