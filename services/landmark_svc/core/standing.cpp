#include "services/landmark_svc/core/standing.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr std::int64_t kForgetAfter_us = 5'000'000;

Eigen::Vector2d in_odom_m(const Pose2& T_odom_robot, const Landmark& landmark) {
  return transform(T_odom_robot,
                   landmark.range_m * Eigen::Vector2d(std::cos(landmark.bearing_rad),
                                                      std::sin(landmark.bearing_rad)));
}

}  // namespace

void Standing::reserve(std::size_t landmarks) {
  for (Past& past : past_) past.seen.reserve(landmarks);
}

void Standing::clear() {
  known_ = 0;
  next_ = 0;
}

bool Standing::has_stood(std::int64_t utime, const Pose2& T_odom_robot, const Landmark& landmark,
                         const StandingParams& params) const {
  const auto before = [utime](double age_s) {
    return utime - static_cast<std::int64_t>(1e6 * age_s);
  };
  const std::int64_t oldest = before(params.age_max_s);
  const Eigen::Vector2d p_odom_m = in_odom_m(T_odom_robot, landmark);
  const std::int64_t youngest = before(params.age_min_s);
  const std::int64_t youngest_proof = is_beside_mover(p_odom_m, oldest, params.mover_reach_m)
                                          ? before(params.age_beside_mover_min_s)
                                          : youngest;
  const double reach_m = params.reach_m + params.reach_ratio * landmark.range_m;
  bool is_known = false;
  for (std::size_t k = 0; k < known_; ++k) {
    if (past_[k].utime > youngest || past_[k].utime < oldest) continue;
    is_known = true;
    if (past_[k].utime > youngest_proof) continue;
    const auto& seen = past_[k].seen;
    if (std::any_of(seen.begin(), seen.end(), [&](const Seen& then) {
          return then.kind == landmark.kind &&
                 (then.p_odom_m - p_odom_m).squaredNorm() < reach_m * reach_m;
        })) {
      return true;
    }
  }
  return !is_known;
}

bool Standing::is_beside_mover(const Eigen::Vector2d& p_odom_m, std::int64_t oldest_utime,
                               double reach_m) const {
  return std::any_of(
      past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(known_), [&](const Past& past) {
        return past.utime >= oldest_utime &&
               std::any_of(past.seen.begin(), past.seen.end(), [&](const Seen& then) {
                 return then.is_moving &&
                        (then.p_odom_m - p_odom_m).squaredNorm() < reach_m * reach_m;
               });
      });
}

void Standing::remember(std::int64_t utime, const Pose2& T_odom_robot,
                        const std::vector<Landmark>& landmarks) {
  const std::int64_t newest = known_ > 0 ? past_[(next_ + kFrames - 1) % kFrames].utime : utime;
  if (utime < newest || utime > newest + kForgetAfter_us) clear();
  Past& past = past_[next_];
  past.utime = utime;
  past.seen.clear();
  for (const Landmark& landmark : landmarks) {
    past.seen.push_back({landmark.kind, in_odom_m(T_odom_robot, landmark), landmark.is_moving});
  }
  next_ = (next_ + 1) % kFrames;
  known_ = std::min(known_ + 1, kFrames);
}

}  // namespace roomwise::landmark
