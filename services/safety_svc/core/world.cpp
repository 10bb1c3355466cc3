#include "services/safety_svc/core/world.h"

#include <cmath>

namespace roomwise::safety {
namespace {

InputResult result_of(StampResult stamp) {
  if (stamp == StampResult::kFromFuture) return InputResult::kFromFuture;
  if (stamp == StampResult::kOld) return InputResult::kOld;
  return stamp == StampResult::kOutOfOrder ? InputResult::kOutOfOrder : InputResult::kUsed;
}

}  // namespace

World::World(const SafetyParams& params) : params_(params) {}

InputResult World::hear_odometry(const Instant& now, const OdometrySample& sample) {
  InputWatch heard = odometry;  // kept only if the rest makes sense as well
  const InputResult stamp = result_of(heard.hear(now, sample.time));
  if (stamp == InputResult::kFromFuture) odometry = heard;
  if (stamp != InputResult::kUsed) return stamp;
  const OdometryResult result = track_.add(now, sample);
  if (result == OdometryResult::kRefused) return InputResult::kMalformed;
  odometry = heard;
  if (result == OdometryResult::kStartedAnew) {
    memory_.forget();
    has_stood_ = has_moved_ = false;
  }
  has_stood_ = has_stood_ || track_.stands();
  has_moved_ = has_moved_ || (has_stood_ && !track_.stands());
  if (has_stood_ && !has_moved_) {
    memory_.overlook_round(now, track_.pose_now(now), params_.start_radius_m);
  }
  return InputResult::kUsed;
}

InputResult World::hear_frame(const Instant& now, Time time, const CameraSetup& setup) {
  const auto mount = mount_of(setup);
  if (!mount) return InputResult::kMalformed;
  const InputResult stamp = result_of(frame.hear(now, time));
  if (stamp == InputResult::kUsed) mount_ = mount;
  return stamp;
}

InputResult World::hear_view(const Instant& now, const FloorView& seen) {
  if (!mount_) return InputResult::kNoMount;
  InputWatch heard = view;  // kept only if the rest makes sense as well
  const InputResult stamp = result_of(heard.hear(now, seen.time));
  if (stamp == InputResult::kFromFuture) view = heard;
  if (stamp != InputResult::kUsed) return stamp;
  const auto T_odom_robot = track_.pose_at(seen.time);
  if (!T_odom_robot) return InputResult::kNoPose;
  FreeView free = seen.free;
  free.floor_seen_from_m = floor_seen_from_m();
  const double own_m = params_.robot_radius_m + params_.margin_m;
  if (!memory_.see(now, *T_odom_robot, free, own_m)) return InputResult::kMalformed;
  view = heard;
  if (seen.is_plane_trusted) {
    is_tilted_ = safety::is_tilted(*mount_, seen.floor_normal, seen.floor_height_m);
  }
  return InputResult::kUsed;
}

double World::floor_seen_from_m() const {
  return params_.floor_seen_from_m > 0.0 ? params_.floor_seen_from_m : mount_->floor_seen_from_m;
}

InputResult World::hear_body(const Instant& now, Time time, const BodyState& body) {
  const InputResult stamp = result_of(body_state.hear(now, time));
  if (stamp != InputResult::kUsed) return stamp;
  feel(now, body);
  body_ = body;
  return stamp;
}

void World::feel(const Instant& now, const BodyState& body) {
  const Pose2 here = track_.pose_now(now);
  if (body.bump && !body_.bump) {
    memory_.touch(now, here, params_.robot_radius_m, Reason::kRemembered);
  }
  if (body.cliff && !body_.cliff) {
    memory_.touch(now, here, params_.robot_radius_m, Reason::kDropOff);
  }
}

bool World::is_calm(const Instant& now) const {
  const RequestArbiter::Slot* const heard = requests.winner(now);
  const bool asks = heard != nullptr && (heard->is_bad || heard->request.speed_mps != 0.0 ||
                                         heard->request.turn_rate_radps != 0.0);
  return !asks && track_.stands() && ahead_vetoes_of(body_).is_empty() && !body_.wheel_drop;
}

}  // namespace roomwise::safety
