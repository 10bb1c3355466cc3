#include "services/safety_svc/safety_service.h"

#include <chrono>
#include <random>
#include <string>

#include "common/auth/command_signature.h"
#include "services/safety_svc/safety_messages.h"

namespace roomwise {
namespace {

using std::chrono::milliseconds;

constexpr Duration kTick = milliseconds(20);
constexpr Duration kStatePeriod = milliseconds(100);

std::int64_t random_session() {
  std::random_device device;
  const std::uint64_t high = device();
  return static_cast<std::int64_t>(((high << 32) | device()) >> 1);
}

const char* name_of(safety::InputResult result) {
  switch (result) {
    case safety::InputResult::kUsed:
      return "used";
    case safety::InputResult::kFromFuture:
      return "from_future";
    case safety::InputResult::kOld:
      return "old";
    case safety::InputResult::kOutOfOrder:
      return "out_of_order";
    case safety::InputResult::kMalformed:
      return "malformed";
    case safety::InputResult::kNoPose:
      return "without_pose";
    case safety::InputResult::kNoMount:
      return "before_any_frame";
  }
  return "unknown";
}

const char* name_of(safety::RequestResult result) {
  switch (result) {
    case safety::RequestResult::kHeard:
      return "request_heard";
    case safety::RequestResult::kNotFinite:
      return "request_not_finite";
    case safety::RequestResult::kOutOfRange:
      return "request_out_of_range";
    case safety::RequestResult::kFromFuture:
      return "request_from_future";
    case safety::RequestResult::kOld:
      return "request_old";
    case safety::RequestResult::kTooManySources:
      return "request_of_too_many_sources";
  }
  return "request_unknown";
}

const char* name_of(safety::ResetResult result) {
  switch (result) {
    case safety::ResetResult::kReset:
      return "reset_done";
    case safety::ResetResult::kNotLatched:
      return "reset_of_nothing";
    case safety::ResetResult::kOtherLatch:
      return "reset_of_another_stop";
    case safety::ResetResult::kStillHeld:
      return "reset_while_held";
    case safety::ResetResult::kNotCalm:
      return "reset_while_not_calm";
  }
  return "reset_unknown";
}

}  // namespace

SafetyService::SafetyService(Bus& bus, const Params& params)
    : bus_(bus), params_(params), world_(params.robot) {
  if (!bus.is_replay()) {
    key_ = params.make_key ? make_key_file(params.key_path) : read_key_file(params.key_path);
    session_ = random_session();
  }
  bus_.subscribe(
      channels::kKinectFrame,
      [this](const kinect_frame_t& m) {
        note("frame", world_.hear_frame(now(), time_from_utime(m.utime), safety::setup_of(m)));
      },
      Delivery::kLatest);
  bus_.subscribe(
      channels::kSegments,
      [this](const segmentation_t& m) {
        const safety::InputResult result = world_.hear_view(now(), safety::view_of(m));
        note("segments", result);
        if (result == safety::InputResult::kUsed) decide();  // not 20 ms later
      },
      Delivery::kLatest);
  bus_.subscribe(channels::kOdometry, [this](const odometry_t& m) {
    note("odometry", world_.hear_odometry(now(), safety::sample_of(m)));
  });
  bus_.subscribe(channels::kVelRequest, [this](const velocity_request_t& m) {
    const auto result = world_.requests.hear(now(), safety::asked_of(m));
    if (result != safety::RequestResult::kHeard) bus_.count(name_of(result));
  });
  bus_.subscribe(channels::kCreateState, [this](const create_state_t& m) { on_create_state(m); });
  bus_.subscribe(channels::kEstop, [this](const estop_t& m) { on_estop(m); });
  bus_.subscribe(channels::kSafetyReset, [this](const safety_reset_t& m) { on_reset(m); });
  bus_.every(kTick, [this](Time) { decide(); });
}

safety::Instant SafetyService::now() const {
  const Time wall = bus_.now();
  if (bus_.is_replay()) return {.steady = wall.time_since_epoch(), .wall = wall};
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  return {.steady = std::chrono::duration_cast<Duration>(steady), .wall = wall};
}

void SafetyService::on_create_state(const create_state_t& message) {
  const safety::BodyState before = world_.body();
  note("create_state",
       world_.hear_body(now(), time_from_utime(message.utime), safety::body_of(message)));
  const bool feels_else = vetoes_of(world_.body()) != vetoes_of(before) ||
                          ahead_vetoes_of(world_.body()) != ahead_vetoes_of(before);
  if (feels_else) decide();
}

void SafetyService::on_estop(const estop_t& message) {
  world_.estop.press(now(), message.held != 0);
  decide();
}

void SafetyService::on_reset(const safety_reset_t& message) {
  const safety::Instant time = now();
  bus_.count(name_of(world_.estop.reset(time, message.latch_id, world_.is_calm(time))));
}

void SafetyService::decide() {
  const safety::Instant time = now();
  world_.tick(time);
  const safety::Decision decision = safety::decide(time, world_, granted_, params_.robot);
  granted_ = {decision.granted, time.steady};
  publish_command(time, decision);
  publish_state_if_due(time, decision);
}

void SafetyService::publish_command(const safety::Instant& now, const safety::Decision& decision) {
  velocity_command_t command = safety::command_of(now, decision);
  command.session = session_;
  command.sequence = ++sequence_;
  if (key_) sign(*key_, command);
  bus_.publish(channels::kVelCmd, command);
}

void SafetyService::publish_state_if_due(const safety::Instant& now,
                                         const safety::Decision& decision) {
  const bool is_news = decision.first != said_.first || decision.reasons != said_.reasons;
  const bool is_due =
      !state_said_ || now.steady - *state_said_ >= kStatePeriod || now.steady < *state_said_;
  if (!is_news && !is_due) return;
  said_ = decision;
  state_said_ = now.steady;
  safety::fill(now, world_, decision, state_);
  bus_.publish(channels::kSafetyState, state_);
}

void SafetyService::note(const char* input, safety::InputResult result) {
  if (result == safety::InputResult::kUsed) return;
  bus_.count(std::string(input) + "_" + name_of(result));
}

}  // namespace roomwise
