#include "services/pilot_svc/core/pilot.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {
namespace {

constexpr double kPlaceMax_m = 1e5;
constexpr double kRefusalActs_s = 0.5;
constexpr Duration kClockBack = std::chrono::seconds(1);  // stamps this much older: a new recording

bool is_place(const Pose2& pose) {
  return std::abs(pose.x_m) < kPlaceMax_m && std::abs(pose.y_m) < kPlaceMax_m &&
         std::abs(pose.heading_rad) < 100.0;  // false for NaN
}

bool is_fresh(Time now, const std::optional<Time>& measured, double age_max_s) {
  return measured && std::abs(seconds(now - *measured)) <= age_max_s;
}

const char* name_of(Failure missing_input) {
  if (missing_input == Failure::kNoOdometry) return "waits for ODOMETRY";
  if (missing_input == Failure::kNoSegments) return "waits for SEGMENTS";
  if (missing_input == Failure::kNoPose) return "waits for POSE";
  return "safety_svc holds it";
}

}  // namespace

Pilot::Pilot(const PilotParams& params)
    : params_(params), memory_(params), stuck_(params), recovery_(params), glance_(params) {
  obstacles_robot_m_.reserve(ObstacleMemory::capacity());
}

void Pilot::set_goal(const Goal& goal) {
  goal_ = goal;
  goal_since_.reset();
  waits_since_.reset();
  stuck_.forget();
  recovery_ = Recovery(params_);
  behaviour_ = std::monostate{};
  report_ = {.behaviour = goal.behaviour};
  if (!is_sound(goal)) return end(State::kFailed, Failure::kBadGoal);
  if (goal.behaviour == Behaviour::kStop) return;
  report_.state = State::kDriving;
  take_up_behaviour();
}

void Pilot::take_up_behaviour() {
  if (goal_.behaviour == Behaviour::kWander) behaviour_.emplace<Wander>(goal_, params_);
  if (goal_.behaviour == Behaviour::kCircle) behaviour_.emplace<Circle>(goal_, params_);
  if (goal_.behaviour == Behaviour::kGoTo) behaviour_.emplace<GoTo>(goal_, params_);
}

InputResult Pilot::add_odometry(const OdometrySample& sample) {
  if (!is_place(sample.T_odom_robot)) return InputResult::kNotFinite;
  InputResult result = InputResult::kUsed;
  if (track_count_ > 0) {
    const OdometrySample& last = track_[(track_count_ - 1) % kTrack];
    const bool is_back = sample.time < last.time - kClockBack;
    if (sample.time <= last.time && !is_back) return InputResult::kOutOfOrder;
    if (is_back || sample.reset_counter != last.reset_counter) {
      start_anew();
      result = InputResult::kStartedAnew;
    } else {
      const Eigen::Vector2d way_m =
          sample.T_odom_robot.position_m() - last.T_odom_robot.position_m();
      report_.driven_m += way_m.norm();
    }
  }
  track_[track_count_++ % kTrack] = sample;
  visits_.visit(sample.time, sample.T_odom_robot.position_m());
  return result;
}

void Pilot::start_anew() {
  memory_.forget();
  visits_.forget();
  track_count_ = 0;
  viewed_.reset();
  posed_.reset();
  waits_since_.reset();
  refused_.reset();
  glance_.forget();
  stuck_.forget();
  recovery_ = Recovery(params_);
  if (report_.state != State::kDone && report_.state != State::kFailed) take_up_behaviour();
}

const OdometrySample* Pilot::odometry_at(Time time) const {
  const std::size_t count = std::min(track_count_, kTrack);
  for (std::size_t back = 1; back <= count; ++back) {
    const OdometrySample& sample = track_[(track_count_ - back) % kTrack];
    if (sample.time <= time) {
      return seconds(time - sample.time) <= params_.odometry_age_max_s ? &sample : nullptr;
    }
  }
  return nullptr;
}

InputResult Pilot::add_view(Time time, const FreeView& view) {
  const OdometrySample* then = odometry_at(time);
  if (then == nullptr) return InputResult::kNoOdometry;
  if (viewed_ && time <= *viewed_) return InputResult::kOutOfOrder;
  if (!memory_.see(time, then->T_odom_robot, view)) return InputResult::kNotFinite;
  viewed_ = time;
  return InputResult::kUsed;
}

InputResult Pilot::add_pose(Time time, const Pose2& T_map_robot, bool is_tracking) {
  if (!is_place(T_map_robot)) return InputResult::kNotFinite;
  const OdometrySample* then = odometry_at(time);
  if (then == nullptr) return InputResult::kNoOdometry;
  if (posed_ && time < *posed_) return InputResult::kOutOfOrder;
  posed_ = time;
  pose_is_tracking_ = is_tracking;
  T_odom_map_ = compose(then->T_odom_robot, inverse(T_map_robot));
  return InputResult::kUsed;
}

void Pilot::add_refusal(const Eigen::Vector2d& p_robot_m) {
  const bool is_near = p_robot_m.norm() < params_.reach_m;  // false for NaN
  if (track_count_ == 0 || !is_near) return;
  const OdometrySample& last = track_[(track_count_ - 1) % kTrack];
  refused_ = last.time;
  if (glance_.is_on()) return;
  memory_.obstacles_round(last.time, last.T_odom_robot, obstacles_robot_m_);
  if (glance_.begin(last.time, last.T_odom_robot, p_robot_m, obstacles_robot_m_)) return;
  memory_.refuse(last.time, transform(last.T_odom_robot, p_robot_m));
}

Failure Pilot::missing(Time now) const {
  if (odometry_at(now) == nullptr) return Failure::kNoOdometry;
  if (!is_fresh(now, viewed_, params_.segments_age_max_s)) return Failure::kNoSegments;
  const bool has_pose = is_fresh(now, posed_, params_.pose_age_max_s) && pose_is_tracking_;
  if (goal_.behaviour == Behaviour::kGoTo && !has_pose) return Failure::kNoPose;
  return Failure::kNone;
}

Motion Pilot::tick(Time now) {
  if (std::holds_alternative<std::monostate>(behaviour_)) return {};
  if (!goal_since_) goal_since_ = now;
  const Failure lack = missing(now);
  if (lack != Failure::kNone || hold_ == Hold::kHeld) return wait(now, lack);
  waits_since_.reset();
  report_.waits_for = "";
  if (goal_.duration_s > 0.0 && seconds(now - *goal_since_) >= goal_.duration_s) {
    end(State::kDone, Failure::kNone);
    return {};
  }
  if (recovery_.is_on()) return recover(now);
  if (glance_.is_on()) return glance_.step(now, odometry_at(now)->T_odom_robot);
  return drive(now);
}

Motion Pilot::wait(Time now, Failure why) {
  if (why == Failure::kNone) waits_since_.reset();  // a person may hold it as long as he likes
  if (why != Failure::kNone && !waits_since_) waits_since_ = now;
  stuck_.forget();
  report_.state = State::kWaiting;
  report_.waits_for = name_of(why);
  if (waits_since_ && seconds(now - *waits_since_) > params_.wait_max_s) end(State::kFailed, why);
  return {};
}

Motion Pilot::recover(Time now) {
  report_.state = State::kRecovering;
  const Motion motion = recovery_.step(now, odometry_at(now)->T_odom_robot);
  stuck_.forget();
  return motion;
}

Motion Pilot::drive(Time now) {
  const Pose2& T_odom_robot = odometry_at(now)->T_odom_robot;
  memory_.obstacles_round(now, T_odom_robot, obstacles_robot_m_);
  const Step step = behave({now, T_odom_robot, obstacles_robot_m_, memory_, visits_});
  report_.state = State::kDriving;
  report_.bearing_rad = step.bearing_rad;
  update_progress(now);
  if (step.state != State::kDriving) {
    end(step.state, step.failure);
    return {};
  }
  if (hold_ != Hold::kTouched && !stuck_.is_stuck(now, T_odom_robot, step.motion)) {
    return is_fresh(now, refused_, kRefusalActs_s) ? turned_first(step) : step.motion;
  }
  // Whatever it believes to stand there did not help: safety_svc knows what must not be entered.
  memory_.forget();
  if (!recovery_.begin(now, T_odom_robot)) end(State::kFailed, Failure::kStuck);
  report_.recoveries = recovery_.count();
  return {};
}

/// Along an arc it would be refused again: it turns to where it means to go, then drives.
Motion Pilot::turned_first(const Step& step) {
  constexpr double kTurned_rad = 0.1;
  Motion motion = step.motion;
  if (std::abs(step.bearing_rad) > kTurned_rad) motion.speed_mps = std::min(motion.speed_mps, 0.0);
  return motion;
}

Step Pilot::behave(const Surroundings& around) {
  if (auto* wander = std::get_if<Wander>(&behaviour_)) return wander->step(around);
  if (auto* circle = std::get_if<Circle>(&behaviour_)) return circle->step(around);
  return std::get<GoTo>(behaviour_).step(around, transform(T_odom_map_, {goal_.x_m, goal_.y_m}));
}

void Pilot::end(State state, Failure failure) {
  behaviour_ = std::monostate{};
  report_.state = state;
  report_.failure = failure;
  report_.waits_for = "";
  if (state == State::kDone) report_.progress.ratio = 1.0;
}

void Pilot::update_progress(Time now) {
  Progress& progress = report_.progress;
  if (goal_.duration_s > 0.0) {
    progress.ratio = std::clamp(seconds(now - *goal_since_) / goal_.duration_s, 0.0, 1.0);
  }
  if (const auto* circle = std::get_if<Circle>(&behaviour_)) {
    progress.ratio = circle->ratio();
    progress.turned_about_object_rad = circle->turned_rad();
    progress.object_distance_m = circle->object_distance_m();
  }
  if (const auto* go_to = std::get_if<GoTo>(&behaviour_)) {
    progress.ratio = go_to->ratio();
    progress.goal_distance_m = go_to->distance_m();
  }
}

}  // namespace roomwise::pilot
