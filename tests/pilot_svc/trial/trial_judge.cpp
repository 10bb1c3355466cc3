#include "tests/pilot_svc/trial/trial_judge.h"

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace roomwise {
namespace {

constexpr double kBody_m = 0.17;
constexpr double kTouching_m = 0.03;
constexpr double kElsewhere_m = 0.1;
constexpr double kTurnsHard_radps = 0.3;
constexpr std::size_t kRecent = 4;

simulator::Scene at_rest(simulator::Scene scene) {
  scene.walkers.clear();
  return scene;
}

simulator::GroundPlan only_holes(simulator::GroundPlan plan) {
  plan.walls.clear();
  plan.discs.clear();
  return plan;
}

double seconds_between(std::int64_t from, std::int64_t to) {
  return 1e-6 * static_cast<double>(to - from);
}

Eigen::Vector2d position_m(const truth_t& truth) { return {truth.true_x_m, truth.true_y_m}; }

bool is_in_force(int state) {
  return state == pilot_state_t::STATE_DRIVING || state == pilot_state_t::STATE_RECOVERING ||
         state == pilot_state_t::STATE_WAITING;
}

double speed_mps(const truth_t& a, const truth_t& b) {
  return (position_m(b) - position_m(a)).norm() / std::max(seconds_between(a.utime, b.utime), 1e-3);
}

}  // namespace

int Verdict::contacts_faster_than(double least_mps) const {
  return static_cast<int>(std::count_if(contacts.begin(), contacts.end(),
                                        [&](const Contact& c) { return c.speed_mps > least_mps; }));
}

TrialJudge::TrialJudge(const simulator::Scene& scene)
    : plan_(simulator::ground_plan(at_rest(scene), 0.0)),
      holes_(only_holes(plan_)),
      coverage_(plan_, scene.start.position_m()) {
  so_far_.nearest_hole_m = so_far_.nearest_m = 1e9;
  so_far_.floor_m2 = coverage_.floor_m2();
}

void TrialJudge::on_truth(const truth_t& truth) {
  if (!is_in_force(state_)) return;
  if (!begun_) {
    begun_ = stands_since_ = truth.utime;
    stands_at_m_ = position_m(truth);
  }
  so_far_.lasted_s = seconds_between(*begun_, truth.utime);
  watch_contact(truth);
  watch_stand(truth);
  watch_circle(truth);
  coverage_.visit(position_m(truth));
  if (!recent_.empty()) so_far_.driven_m += (position_m(truth) - position_m(recent_.back())).norm();
  recent_.push_back(truth);
  if (recent_.size() > kRecent) recent_.erase(recent_.begin());
}

void TrialJudge::watch_contact(const truth_t& truth) {
  const double hole_m = simulator::clearance_m(holes_, position_m(truth));
  so_far_.nearest_hole_m = std::min(so_far_.nearest_hole_m, hole_m - kBody_m);
  if (hole_m < 0.0 && !is_over_hole_) ++so_far_.falls;
  is_over_hole_ = hole_m < 0.0;
  if (truth.contacts == 0 || recent_.empty() || recent_.back().contacts > 0) return;
  Contact contact{.at_s = so_far_.lasted_s, .x_m = truth.true_x_m, .y_m = truth.true_y_m};
  for (std::size_t i = 1; i < recent_.size(); ++i) {
    contact.speed_mps = std::max(contact.speed_mps, speed_mps(recent_[i - 1], recent_[i]));
  }
  contact.is_with_walker = simulator::clearance_m(plan_, position_m(truth)) > kBody_m + kTouching_m;
  so_far_.contacts.push_back(contact);
}

void TrialJudge::watch_stand(const truth_t& truth) {
  if ((position_m(truth) - stands_at_m_).norm() > kElsewhere_m) {
    stands_at_m_ = position_m(truth);
    stands_since_ = truth.utime;
  }
  so_far_.longest_stand_s =
      std::max(so_far_.longest_stand_s, seconds_between(stands_since_, truth.utime));
}

void TrialJudge::watch_circle(const truth_t& truth) {
  if (so_far_.last.turned_about_object_rad == 0.0) return;
  const double gap_m = simulator::clearance_m(plan_, position_m(truth)) - kBody_m;
  so_far_.nearest_m = std::min(so_far_.nearest_m, gap_m);
  so_far_.farthest_m = std::max(so_far_.farthest_m, gap_m);
}

void TrialJudge::on_pilot_state(const pilot_state_t& state) {
  if (is_in_force(state_)) so_far_.spent_s[state_] += seconds_between(state_utime_, state.utime);
  state_ = state.state;
  state_utime_ = state.utime;
  so_far_.last = state;
}

void TrialJudge::on_safety_state(const safety_state_t& state) {
  const bool asks = state.asked_speed_mps != 0.0 || state.asked_turn_rate_radps != 0.0;
  const bool stops = is_in_force(state_) && asks && state.granted_speed_mps == 0.0 &&
                     state.granted_turn_rate_radps == 0.0 && state.reason_count > 0;
  if (!stop_.empty()) so_far_.stopped_s[stop_] += seconds_between(safety_utime_, state.utime);
  const std::string why = stops ? state.reason_text : std::string();
  if (stops && stop_ != why) ++so_far_.stops[why];
  stop_ = why;
  safety_utime_ = state.utime;
}

void TrialJudge::on_command(const velocity_command_t& command) {
  const double rate_radps = command.allowed_turn_rate_radps;
  if (!is_in_force(state_) || std::abs(rate_radps) < kTurnsHard_radps) return;
  const bool is_other_way = rate_radps * turned_radps_ < 0.0;
  if (is_other_way && seconds_between(turned_utime_, command.utime) < 1.0) ++so_far_.turnings;
  turned_radps_ = rate_radps;
  turned_utime_ = command.utime;
}

Verdict TrialJudge::verdict() const {
  Verdict verdict = so_far_;
  verdict.covered_ratio = coverage_.ratio();
  return verdict;
}

std::ostream& operator<<(std::ostream& out, const Verdict& v) {
  out << std::fixed << std::setprecision(1) << v.lasted_s << " s, " << v.driven_m << " m driven, "
      << 100.0 * v.covered_ratio << " % of " << v.floor_m2 << " m2 covered, "
      << v.contacts_faster_than(0.1) << " contacts faster than 0.1 m/s of " << v.contacts.size()
      << ", " << v.falls << " falls, stood still at most " << v.longest_stand_s << " s, "
      << v.last.recoveries << " recoveries, " << v.turnings << " turnings\n";
  if (v.nearest_hole_m < 1e8) out << "nearest hole " << v.nearest_hole_m << " m\n";
  if (v.last.turned_about_object_rad != 0.0) {
    out << std::setprecision(3) << "round the object " << v.last.turned_about_object_rad
        << " rad, between " << v.nearest_m << " and " << v.farthest_m << " m from it\n";
  }
  for (const Contact& c : v.contacts) {
    out << std::setprecision(2) << "contact at " << c.at_s << " s, (" << c.x_m << ", " << c.y_m
        << "), " << c.speed_mps << " m/s" << (c.is_with_walker ? ", somebody walks\n" : "\n");
  }
  out << std::setprecision(1);
  for (const auto& [why, count] : v.stops) {
    const auto found = v.stopped_s.find(why);
    out << "stopped " << count << " times, " << (found == v.stopped_s.end() ? 0.0 : found->second)
        << " s: " << why << "\n";
  }
  for (const auto& [state, time_s] : v.spent_s)
    out << "state " << state << ": " << time_s << " s\n";
  return out << "ends in state " << int{v.last.state} << ", failure " << int{v.last.failure} << " "
             << v.last.explanation << "\n";
}

}  // namespace roomwise
