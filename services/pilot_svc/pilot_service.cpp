#include "services/pilot_svc/pilot_service.h"

#include <string>

#include "services/pilot_svc/pilot_messages.h"

namespace roomwise {
namespace {

constexpr Duration kTickPeriod = std::chrono::milliseconds(50);
constexpr Duration kStatePeriod = std::chrono::milliseconds(200);
constexpr Duration kClockJump = std::chrono::seconds(2);
/// Times that no arithmetic on them can overflow; some 30 000 years.
constexpr std::int64_t kUtimeMax = 1'000'000'000'000'000'000;

bool is_time(std::int64_t utime) { return utime > 0 && utime < kUtimeMax; }

constexpr const char* name_of(pilot::InputResult result) {
  switch (result) {
    case pilot::InputResult::kUsed:
      return "_used";
    case pilot::InputResult::kNotFinite:
      return "_not_finite";
    case pilot::InputResult::kOutOfOrder:
      return "_out_of_order";
    case pilot::InputResult::kNoOdometry:
      return "_without_odometry";
    case pilot::InputResult::kStartedAnew:
      return "_started_anew";
  }
  return "_unknown";
}

}  // namespace

PilotService::PilotService(Bus& bus, const Params& params)
    : bus_(bus),
      pilot_(params),
      request_life_(static_cast<std::int64_t>(params.request_life_s * 1e6)) {
  bus_.subscribe(channels::kPilotGoal, [this](const pilot_goal_t& m) { on_goal(m); });
  bus_.subscribe(channels::kOdometry, [this](const odometry_t& m) { on_odometry(m); });
  bus_.subscribe(channels::kSegments, [this](const segmentation_t& m) { on_segments(m); });
  bus_.subscribe(channels::kPose, [this](const pose_t& m) { on_pose(m); });
  bus_.subscribe(channels::kSafetyState, [this](const safety_state_t& m) {
    pilot_.set_hold(to_hold(m));
    if (const auto p_robot_m = to_refusal(m)) pilot_.add_refusal(*p_robot_m);
  });
}

void PilotService::on_goal(const pilot_goal_t& message) {
  if (!is_time(message.utime)) return bus_.count("goal_time_invalid");
  if (now_ == Time{}) now_ = time_from_utime(message.utime);
  goal_utime_ = message.utime;
  has_goal_ = true;
  pilot_.set_goal(to_goal(message));
  publish_request(now_, {});
  publish_state(now_);
}

void PilotService::on_odometry(const odometry_t& message) {
  if (!is_time(message.utime)) return bus_.count("odometry_time_invalid");
  const Time time = time_from_utime(message.utime);
  const auto result = pilot_.add_odometry(
      {time, {message.x_m, message.y_m, message.heading_rad}, message.reset_counter});
  count("odometry", result);
  if (result == pilot::InputResult::kStartedAnew) now_ = time;
  const bool has_jumped = time - now_ > kClockJump || now_ - time > kClockJump;
  if (result == pilot::InputResult::kUsed && has_jumped) now_ = time - kTickPeriod;
  if (result == pilot::InputResult::kUsed) advance(time);
}

void PilotService::on_segments(const segmentation_t& message) {
  if (!is_time(message.utime)) return bus_.count("segments_time_invalid");
  const Time time = time_from_utime(message.utime);
  count("segments", pilot_.add_view(time, {message.bin_first_bearing_rad, message.bin_step_rad,
                                           message.free_range_m, message.unknown_ratio,
                                           message.obstacle_range_m}));
  advance(time - kStatePeriod);
}

void PilotService::on_pose(const pose_t& message) {
  if (!is_time(message.utime)) return bus_.count("pose_time_invalid");
  const Time time = time_from_utime(message.utime);
  const bool is_tracking =
      message.state == pose_t::STATE_TRACKING || message.state == pose_t::STATE_RELOCALISED;
  count("pose",
        pilot_.add_pose(time, {message.x_m, message.y_m, message.heading_rad}, is_tracking));
  advance(time - kStatePeriod);
}

void PilotService::count(std::string_view input, pilot::InputResult result) {
  if (result != pilot::InputResult::kUsed) bus_.count(std::string(input) + name_of(result));
}

void PilotService::advance(Time time) {
  if (time < next_multiple(now_, kTickPeriod) || time - now_ > kClockJump) return;
  now_ = time;
  const pilot::Motion motion = pilot_.tick(now_);
  if (has_goal_) publish_request(now_, motion);
  if (pilot_.report().state != state_ || now_ - state_published_ >= kStatePeriod) {
    publish_state(now_);
  }
}

void PilotService::publish_request(Time time, const pilot::Motion& motion) {
  velocity_request_t request{};
  request.utime = utime_of(time);
  request.source = "pilot_svc";
  request.priority = velocity_request_t::PRIORITY_PILOT;
  request.valid_for_us = request_life_.count();
  request.requested_speed_mps = motion.speed_mps;
  request.requested_turn_rate_radps = motion.turn_rate_radps;
  bus_.publish(channels::kVelRequest, request);
}

void PilotService::publish_state(Time time) {
  pilot_state_t message = to_state_message(pilot_.report());
  message.utime = utime_of(time);
  message.goal_utime = goal_utime_;
  bus_.publish(channels::kPilotState, message);
  state_ = pilot_.report().state;
  state_published_ = time;
}

}  // namespace roomwise
