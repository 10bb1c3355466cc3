#include "services/safety_svc/core/odometry_track.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "services/safety_svc/core/arc.h"
#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;

constexpr double kFastest_mps = 2.0;  // no Create's wheels turn faster
constexpr double kFastest_radps = 20.0;
constexpr double kFarthest_m = 1e5;  // of a pose from its start
constexpr Duration kIntervalMax = std::chrono::seconds(5);
constexpr Duration kAheadMax = milliseconds(200);
constexpr double kMarkStep_m = 0.02;
constexpr int kReverseSteps = 25;
static_assert(kReverseSteps * kMarkStep_m == kReverse_m);

bool is_sound(const OdometrySample& sample) {
  const Pose2& pose = sample.T_odom_robot;
  if (sample.interval <= Duration(0) || sample.interval > kIntervalMax) return false;
  const double dt_s = seconds(sample.interval);
  // Not finite compares false.
  return std::abs(sample.distance_m) <= kFastest_mps * dt_s &&
         std::abs(sample.turn_rad) <= kFastest_radps * dt_s && std::abs(pose.x_m) < kFarthest_m &&
         std::abs(pose.y_m) < kFarthest_m && std::abs(pose.heading_rad) < 4.0;
}

Pose2 moved_on(const Pose2& pose, double speed_mps, double turn_rate_radps, double dt_s) {
  const double half_rad = 0.5 * turn_rate_radps * dt_s;
  const double way_m = speed_mps * dt_s;
  return compose(pose, {way_m * std::cos(half_rad), way_m * std::sin(half_rad), 2.0 * half_rad});
}

Pose2 between(const OdometrySample& a, const OdometrySample& b, Time time) {
  const double share = seconds(time - a.time) / seconds(b.time - a.time);
  const Pose2& p = a.T_odom_robot;
  const Pose2& q = b.T_odom_robot;
  return {std::lerp(p.x_m, q.x_m, share), std::lerp(p.y_m, q.y_m, share),
          wrap_angle(p.heading_rad + share * wrap_angle(q.heading_rad - p.heading_rad))};
}

}  // namespace

OdometryResult OdometryTrack::add(const Instant& now, const OdometrySample& sample) {
  if (!is_sound(sample)) return OdometryResult::kRefused;
  const bool is_new = count_ == 0 || sample.reset_counter != newest(0).reset_counter;
  if (is_new) start_anew();
  samples_[count_ % kSamples] = sample;
  ++count_;
  received_ = now.steady;
  speed_mps_ = sample.distance_m / seconds(sample.interval);
  turn_rate_radps_ = sample.turn_rad / seconds(sample.interval);
  if (sample.distance_m >= 0.0) leave_mark(now, sample.T_odom_robot);
  return is_new ? OdometryResult::kStartedAnew : OdometryResult::kUsed;
}

void OdometryTrack::start_anew() {
  count_ = 0;
  mark_count_ = 0;
}

void OdometryTrack::leave_mark(const Instant& now, const Pose2& pose) {
  if (mark_count_ > 0) {
    const Pose2& last = marks_[(mark_count_ - 1) % kMarks].T_odom_robot;
    // either bound: a track is not known to a bit.
    if ((pose.position_m() - last.position_m()).norm() < kMarkStep_m) return;
  }
  marks_[mark_count_ % kMarks] = {pose, now.steady};
  ++mark_count_;
}

std::optional<Pose2> OdometryTrack::pose_at(Time time) const {
  if (count_ == 0) return std::nullopt;
  const OdometrySample& last = newest(0);
  if (time >= last.time) {
    if (time - last.time > kAheadMax) return std::nullopt;
    return moved_on(last.T_odom_robot, speed_mps_, turn_rate_radps_, seconds(time - last.time));
  }
  for (std::size_t back = 1; back < std::min(count_, kSamples); ++back) {
    if (newest(back).time <= time) return between(newest(back), newest(back - 1), time);
  }
  return std::nullopt;
}

Pose2 OdometryTrack::pose_now(const Instant& now) const {
  if (count_ == 0) return {};
  const Duration age = std::clamp(now.steady - received_, Duration(0), kOdometryAge);
  return moved_on(newest(0).T_odom_robot, speed_mps_, turn_rate_radps_, seconds(age));
}

bool OdometryTrack::stands() const {
  return std::abs(speed_mps_) <= kStanding_mps && std::abs(turn_rate_radps_) <= kStanding_radps;
}

double OdometryTrack::reverse_way_m(const Instant& now, double curvature_radpm) const {
  const Pose2 here = pose_now(now);
  double way_m = 0.0;
  for (int step = 1; step <= kReverseSteps; ++step) {
    const double next_m = step * kMarkStep_m;
    if (!is_near_track(now, compose(here, along_arc(-next_m, curvature_radpm)))) break;
    way_m = next_m;
  }
  return way_m;
}

bool OdometryTrack::is_near_track(const Instant& now, const Pose2& pose) const {
  for (std::size_t back = 0; back < std::min(mark_count_, kMarks); ++back) {
    const Mark& mark = marks_[(mark_count_ - 1 - back) % kMarks];
    if (now.steady - mark.passed > kTrackLife) return false;
    const double away_m = (mark.T_odom_robot.position_m() - pose.position_m()).norm();
    // either bound: a track is not known to a bit.
    if (away_m <= kTrackTolerance_m) return true;
  }
  return false;
}

}  // namespace roomwise::safety
