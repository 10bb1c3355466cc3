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

std::int64_t us_from_s(double time_s) { return static_cast<std::int64_t>(1e6 * time_s); }

/// The stretches of time before a frame in which a landmark was looked for, and found: a bit each.
class Stretches {
 public:
  /// As many of that length as `reach_us` back take.
  Stretches(std::int64_t length_us, std::int64_t reach_us)
      : length_us_(std::max<std::int64_t>(length_us, 1)),
        count_(std::min<std::int64_t>((reach_us + length_us_ - 1) / length_us_, 64)) {}

  void add(std::int64_t age_us, bool is_found) {
    const std::int64_t index = (age_us - 1) / length_us_;
    if (age_us <= 0 || index >= count_) return;
    const auto bit = std::uint64_t{1} << index;
    looked_ |= bit;
    if (is_found) found_ |= bit;
  }
  bool all_found() const { return looked_ == found_; }

 private:
  std::int64_t length_us_;
  std::int64_t count_;
  std::uint64_t looked_ = 0;
  std::uint64_t found_ = 0;
};

}  // namespace

void Standing::reserve(std::size_t landmarks) {
  for (Past& past : past_) past.seen.reserve(landmarks);
}

void Standing::clear() {
  known_ = 0;
  next_ = 0;
  moved_utime_.reset();
}

bool Standing::has_stood(std::int64_t utime, const Pose2& T_odom_robot, const Landmark& landmark,
                         const StandingParams& params) const {
  const Eigen::Vector2d p_odom_m = in_odom_m(T_odom_robot, landmark);
  const double reach_m = params.reach_m + params.reach_ratio * landmark.range_m;
  const Wait wait = wait_of(utime, p_odom_m, reach_m, params);
  Stretches stretches(wait.gap_us, wait.age_us);
  bool is_known = false;
  bool was_there = false;
  for (std::size_t k = 0; k < known_; ++k) {
    const std::int64_t age_us = utime - past_[k].utime;
    if (age_us > us_from_s(params.age_max_s)) continue;
    const auto& seen = past_[k].seen;
    const bool is_found = std::any_of(seen.begin(), seen.end(), [&](const Seen& then) {
      return then.kind == landmark.kind &&
             (then.p_odom_m - p_odom_m).squaredNorm() < reach_m * reach_m;
    });
    is_known = is_known || age_us >= us_from_s(params.age_min_s);
    was_there = was_there || (is_found && age_us >= wait.age_us);
    stretches.add(age_us, is_found);
  }
  return !is_known || (was_there && stretches.all_found());
}

template <class Test>
bool Standing::any_seen_since(std::int64_t oldest_utime, Test test) const {
  return std::any_of(
      past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(known_), [&](const Past& past) {
        return past.utime >= oldest_utime && std::any_of(past.seen.begin(), past.seen.end(), test);
      });
}

Standing::Wait Standing::wait_of(std::int64_t utime, const Eigen::Vector2d& p_odom_m,
                                 double reach_m, const StandingParams& params) const {
  const std::int64_t oldest = utime - us_from_s(params.age_max_s);
  const double near_m2 = params.mover_reach_m * params.mover_reach_m;
  const auto distance_m2 = [&](const Seen& then) {
    return (then.p_odom_m - p_odom_m).squaredNorm();
  };
  if (any_seen_since(oldest, [&](const Seen& then) {
        return then.is_moving && distance_m2(then) < near_m2;
      })) {
    return {us_from_s(params.age_beside_mover_min_s), us_from_s(params.gap_beside_mover_max_s)};
  }
  const std::int64_t always_us = us_from_s(params.age_max_s);
  if (!moved_utime_ || utime - *moved_utime_ >= us_from_s(params.wary_s)) {
    return {us_from_s(params.age_min_s), always_us};
  }
  // What is in doubt at its own place is the landmark itself, a moment ago.
  const bool is_beside_doubt = any_seen_since(oldest, [&](const Seen& then) {
    return then.is_in_doubt && distance_m2(then) >= reach_m * reach_m &&
           distance_m2(then) < near_m2;
  });
  const double walked_s = std::min(reach_m / params.slow_walk_mps, params.age_max_s);
  return {us_from_s(std::max(is_beside_doubt ? params.age_beside_doubt_min_s : params.age_min_s,
                             walked_s)),
          always_us};
}

void Standing::remember(std::int64_t utime, const Pose2& T_odom_robot,
                        const std::vector<Landmark>& landmarks) {
  const std::int64_t newest = known_ > 0 ? past_[(next_ + kFrames - 1) % kFrames].utime : utime;
  if (utime < newest || utime > newest + kForgetAfter_us) clear();
  const auto moves = [](const Seen& seen) { return seen.is_moving; };
  const bool moved_before = any_seen_since(newest - kForgetAfter_us, moves);
  Past& past = past_[next_];
  past.utime = utime;
  past.seen.clear();
  for (const Landmark& landmark : landmarks) {
    past.seen.push_back(
        {landmark.kind, in_odom_m(T_odom_robot, landmark), landmark.is_moving, false});
  }
  const bool moves_now = std::any_of(past.seen.begin(), past.seen.end(), moves);
  if (moves_now && moved_before) moved_utime_ = utime;
  next_ = (next_ + 1) % kFrames;
  known_ = std::min(known_ + 1, kFrames);
}

void Standing::remember_doubts(const std::vector<Landmark>& landmarks) {
  if (known_ == 0) return;
  auto& seen = past_[(next_ + kFrames - 1) % kFrames].seen;
  for (std::size_t i = 0; i < std::min(seen.size(), landmarks.size()); ++i) {
    seen[i].is_in_doubt = landmarks[i].is_moving;
  }
}

}  // namespace roomwise::landmark
