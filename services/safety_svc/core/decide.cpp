#include "services/safety_svc/core/decide.h"

#include <algorithm>
#include <cmath>

#include "services/safety_svc/core/stopping.h"

namespace roomwise::safety {
namespace {

constexpr double kTooSlow_mps = 1e-3;  // counts as turning on the spot
constexpr double kLookAhead_m = 0.1;   // beyond the stopping distance

ReasonSet vetoes(const Instant& now, const World& world) {
  ReasonSet reasons = vetoes_of(world.body());
  if (world.estop.is_latched()) reasons.add(Reason::kEstop);
  const bool sees = world.view.is_fresh(now, kCameraAge) && world.frame.is_fresh(now, kCameraAge);
  if (!sees) reasons.add(Reason::kNoCamera);
  if (!world.odometry.is_fresh(now, kOdometryAge)) reasons.add(Reason::kNoOdometry);
  if (!world.body_state.is_fresh(now, kCreateStateAge)) reasons.add(Reason::kNoCreateState);
  const bool distrusts = world.clock.is_distrusted(now) || world.view.is_distrusted(now) ||
                         world.frame.is_distrusted(now) || world.odometry.is_distrusted(now) ||
                         world.body_state.is_distrusted(now);
  if (distrusts) reasons.add(Reason::kClock);
  return reasons;
}

/// Brings a motion under limits, keeping its curvature and the reasons.
class Limiter {
 public:
  Limiter(const Request& asked, Decision& decision) : decision_(decision) {
    decision_.granted = asked;
    if (std::abs(asked.speed_mps) < kTooSlow_mps) decision_.granted.speed_mps = 0.0;
    decision_.speed_limit_mps = std::abs(decision_.granted.speed_mps);
  }

  void limit_speed(double most_mps, Reason reason) {
    scale(most_mps, std::abs(decision_.granted.speed_mps), reason);
  }
  void limit_turn_rate(double most_radps, Reason reason) {
    scale(most_radps, std::abs(decision_.granted.turn_rate_radps), reason);
  }
  /// The turn rate alone: the curvature changes.
  void hold_turn_rate(double most_radps, Reason reason) {
    double& rate_radps = decision_.granted.turn_rate_radps;
    if (std::abs(rate_radps) <= most_radps) return;
    rate_radps = std::copysign(most_radps, rate_radps);
    note(reason);
  }

 private:
  void scale(double most, double is, Reason reason) {
    if (is <= most) return;
    decision_.granted.speed_mps *= most / is;
    decision_.granted.turn_rate_radps *= most / is;
    decision_.speed_limit_mps = std::abs(decision_.granted.speed_mps);
    note(reason);
  }
  void note(Reason reason) {
    decision_.reasons.add(reason);
    decision_.first = reason;  // the last to bite decides
  }

  Decision& decision_;
};

/// The most of `is`'s kind that may follow `was` after `dt_s`: nothing is kept across a reversal.
double most_after(double is, double was, double rate, double dt_s) {
  const double kept = std::signbit(is) == std::signbit(was) ? std::abs(was) : 0.0;
  return kept + rate * dt_s;
}

void ramp(const Instant& now, const Granted& before, const Decision& decision, Limiter& limiter) {
  const double dt_s = std::clamp(seconds(now.steady - before.when), 0.0, kStepMax_s);
  limiter.limit_speed(
      most_after(decision.granted.speed_mps, before.motion.speed_mps, kAcceleration_mps2, dt_s),
      Reason::kAcceleration);
  limiter.hold_turn_rate(most_after(decision.granted.turn_rate_radps, before.motion.turn_rate_radps,
                                    kTurnAcceleration_radps2, dt_s),
                         Reason::kAcceleration);
}

void go_ahead(const Instant& now, const World& world, const SafetyParams& params,
              Decision& decision, Limiter& limiter) {
  const Request motion = decision.granted;
  const double length_m = stopping_distance_m(motion.speed_mps) + kLookAhead_m;
  const double curvature = motion.turn_rate_radps / std::max(motion.speed_mps, kTooSlow_mps);
  decision.corridor =
      sweep(now, world.memory(), world.track().pose_now(now), curvature, length_m, params);
  const CorridorView& corridor = decision.corridor;
  if (world.body().near_wall) limiter.limit_speed(kCreep_mps, Reason::kWall);
  if (corridor.known_m < corridor.free_m) {
    limiter.limit_speed(std::max(kCreep_mps, stopping_speed_mps(corridor.known_m)),
                        Reason::kUnknown);
  }
  limiter.limit_speed(stopping_speed_mps(corridor.free_m), corridor.end);
}

void go_back(const Decision& decision, Limiter& limiter) {
  limiter.limit_speed(kCreep_mps, Reason::kReverse);
  limiter.limit_speed(stopping_speed_mps(decision.reverse_way_m), Reason::kReverse);
}

double curvature_radpm(const Request& motion) {
  return motion.speed_mps < 0.0 ? motion.turn_rate_radps / motion.speed_mps : 0.0;
}

void stop(const ReasonSet& reasons, Decision& decision) {
  decision.granted = {};
  decision.speed_limit_mps = 0.0;
  decision.reasons = reasons;
  decision.first = reasons.first();
}

}  // namespace

Decision decide(const Instant& now, const World& world, const Granted& before,
                const SafetyParams& params) {
  Decision decision;
  ReasonSet held = vetoes(now, world);
  const RequestArbiter::Slot* const heard = world.requests.winner(now);
  if (heard == nullptr) held.add(Reason::kNoRequest);
  if (heard != nullptr && heard->is_bad) held.add(Reason::kBadRequest);
  Limiter limiter(heard == nullptr ? Request{} : heard->request, decision);
  const Request& granted = decision.granted;
  decision.reverse_way_m = world.track().reverse_way_m(now, curvature_radpm(granted));
  const bool moves = granted.speed_mps != 0.0 || granted.turn_rate_radps != 0.0;
  if (moves && granted.speed_mps >= 0.0) held.add(ahead_vetoes_of(world.body()));
  if (granted.speed_mps > 0.0 && world.is_tilted()) held.add(Reason::kTilt);
  if (!held.is_empty()) {
    stop(held, decision);
    return decision;
  }
  limiter.limit_speed(params.speed_max_mps, Reason::kSpeedLimit);
  limiter.limit_turn_rate(params.turn_rate_max_radps, Reason::kSpeedLimit);
  ramp(now, before, decision, limiter);
  if (granted.speed_mps > 0.0) {
    go_ahead(now, world, params, decision, limiter);
  } else {
    go_back(decision, limiter);  // what turns on the spot has no speed to limit
  }
  return decision;
}

}  // namespace roomwise::safety
