#include "services/landmark_svc/odometry_track.h"

#include <algorithm>
#include <cmath>

namespace roomwise {

OdometryTrack::Result OdometryTrack::take(const odometry_t& message) {
  constexpr double kFarthest_m = 1e6;
  constexpr std::int64_t kLatest_utime = std::int64_t{1} << 60;
  const auto is_usable = [](double value) { return std::abs(value) <= kFarthest_m; };
  if (!is_usable(message.x_m) || !is_usable(message.y_m) || !is_usable(message.heading_rad) ||
      message.utime < 0 || message.utime > kLatest_utime) {
    return Result::kNotUsable;
  }
  const bool anew =
      known_ > 0 && (message.reset_counter != reset_counter_ || message.utime <= newest(0).utime);
  if (anew) known_ = 0;
  reset_counter_ = message.reset_counter;
  entries_[next_] = {message.utime, {message.x_m, message.y_m, wrap_angle(message.heading_rad)}};
  next_ = (next_ + 1) % kMost;
  known_ = std::min(known_ + 1, kMost);
  return anew ? Result::kStartedAnew : Result::kOk;
}

std::optional<Pose2> OdometryTrack::at(std::int64_t utime) const {
  constexpr std::int64_t kBeyond_us = 100'000;
  if (known_ < 2 || utime < 0 || utime > newest(0).utime + kBeyond_us) return std::nullopt;
  for (std::size_t back = 0; back + 1 < known_; ++back) {
    const Entry& after = newest(back);
    const Entry& before = newest(back + 1);
    if (utime < before.utime) continue;
    const double t =
        static_cast<double>(utime - before.utime) / static_cast<double>(after.utime - before.utime);
    const Pose2& a = before.pose;
    const Pose2& b = after.pose;
    return Pose2{a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m),
                 wrap_angle(a.heading_rad + t * wrap_angle(b.heading_rad - a.heading_rad))};
  }
  return std::nullopt;
}

}  // namespace roomwise
