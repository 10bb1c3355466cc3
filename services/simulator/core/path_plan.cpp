#include "services/simulator/core/path_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace roomwise::simulator {
namespace {

constexpr double kSharpestCurve_rad = 2.2;
constexpr int kIntervals = 16;  // of Simpson's rule per phase of a curve: good to a micrometre

using Nodes = std::vector<Eigen::Vector2d>;

Eigen::Vector2d direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

double heading_of(const Eigen::Vector2d& leg) { return std::atan2(leg.y(), leg.x()); }

/// Integral of the unit vector along the heading over [from_s, to_s], by Simpson's rule.
Eigen::Vector2d integrate(const SpeedProfile& heading, double from_s, double to_s) {
  const double step_s = (to_s - from_s) / kIntervals;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * direction(heading.at(from_s + i * step_s).way);
  }
  return sum * (step_s / 3.0);
}

/// How far a curve to the left has come after `t_s` at unit speed, from heading 0. Phase by phase:
/// across their borders the heading is not smooth enough for the rule.
Eigen::Vector2d curve_offset(const SpeedProfile& heading, double t_s) {
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  double from_s = 0.0;
  for (const double border_s : {heading.up_s(), heading.down_from_s(), heading.duration_s()}) {
    const double to_s = std::min(border_s, t_s);
    if (to_s > from_s) offset += integrate(heading, from_s, to_s);
    from_s = std::max(from_s, to_s);
  }
  return offset;
}

SpeedProfile turn_profile(double turn_rad, const DriveLimits& limits) {
  return {std::abs(turn_rad), 0.0, 0.0, {limits.turn_radps, limits.turn_acceleration_radps2}};
}

/// How far before its corner a curve begins; by symmetry it ends as far behind it.
double cut_m(double turn_rad, const DriveLimits& limits) {
  const SpeedProfile heading = turn_profile(turn_rad, limits);
  return limits.speed_mps * curve_offset(heading, heading.duration_s()).x() /
         (1.0 + std::cos(turn_rad));
}

Nodes nodes_of(const Pose2& start, const Path& path) {
  Nodes nodes_m{start.position_m()};
  for (int round = 0; round < path.rounds; ++round) {
    nodes_m.insert(nodes_m.end(), path.corners_m.begin(), path.corners_m.end());
    nodes_m.push_back(start.position_m());
  }
  for (std::size_t i = 1; i < nodes_m.size(); ++i) {
    if (nodes_m[i] == nodes_m[i - 1]) {
      throw std::invalid_argument("path " + path.name + ": two corners are the same place");
    }
  }
  return nodes_m;
}

/// How a node between two legs is passed.
struct Corner {
  double turn_rad = 0.0;
  double cut_m = 0.0;  ///< of the legs before and after it
  bool rolling = false;
};

Corner corner_between(const Eigen::Vector2d& leg, const Eigen::Vector2d& next,
                      const DriveLimits& limits) {
  const double turn_rad = wrap_angle(heading_of(next) - heading_of(leg));
  if (std::abs(turn_rad) > kSharpestCurve_rad) return {turn_rad, 0.0, false};
  // Half of each leg belongs to each of its ends: enough for the curve and to gain full speed.
  const double gaining_m = limits.speed_mps * limits.speed_mps / limits.acceleration_mps2 / 2.0;
  const double cut = cut_m(turn_rad, limits);
  if (cut + gaining_m > std::min(leg.norm(), next.norm()) / 2.0) return {turn_rad, 0.0, false};
  return {turn_rad, cut, true};
}

}  // namespace

DrivePlan::DrivePlan(const Pose2& start, const Path& path, const DriveLimits& limits)
    : limits_(limits) {
  const Nodes nodes_m = nodes_of(start, path);
  const double first_rad = heading_of(nodes_m[1] - nodes_m[0]);
  const double last_rad = heading_of(nodes_m.back() - nodes_m[nodes_m.size() - 2]);
  add_spot(start, wrap_angle(first_rad - start.heading_rad));
  add_legs(nodes_m);
  add_spot({start.x_m, start.y_m, wrap_angle(last_rad)}, wrap_angle(start.heading_rad - last_rad));
}

void DrivePlan::add_legs(const Nodes& nodes_m) {
  Corner before;
  for (std::size_t i = 1; i < nodes_m.size(); ++i) {
    const Eigen::Vector2d leg = nodes_m[i] - nodes_m[i - 1];
    const double heading_rad = wrap_angle(heading_of(leg));
    Corner after;
    if (i + 1 < nodes_m.size()) after = corner_between(leg, nodes_m[i + 1] - nodes_m[i], limits_);
    const Eigen::Vector2d from_m = nodes_m[i - 1] + before.cut_m * leg.normalized();
    add(Kind::kStraight, {from_m.x(), from_m.y(), heading_rad}, 0.0,
        {leg.norm() - before.cut_m - after.cut_m,
         before.rolling ? limits_.speed_mps : 0.0,
         after.rolling ? limits_.speed_mps : 0.0,
         {limits_.speed_mps, limits_.acceleration_mps2}});
    const Eigen::Vector2d to_m = nodes_m[i] - after.cut_m * leg.normalized();
    const Pose2 at_corner{to_m.x(), to_m.y(), heading_rad};
    if (after.rolling) {
      add(Kind::kCurve, at_corner, after.turn_rad < 0.0 ? -1.0 : 1.0,
          turn_profile(after.turn_rad, limits_));
    } else {
      add_spot(at_corner, after.turn_rad);
    }
    before = after;
  }
}

void DrivePlan::add(Kind kind, const Pose2& from, double sense, const SpeedProfile& profile) {
  pieces_.push_back({kind, from, sense, profile, duration_s()});
}

void DrivePlan::add_spot(const Pose2& from, double turn_rad) {
  add(Kind::kSpot, from, turn_rad < 0.0 ? -1.0 : 1.0, turn_profile(turn_rad, limits_));
}

double DrivePlan::duration_s() const {
  return pieces_.empty() ? 0.0 : pieces_.back().start_s + pieces_.back().profile.duration_s();
}

double DrivePlan::length_m() const {
  double sum_m = 0.0;
  for (const Piece& piece : pieces_) {
    if (piece.kind == Kind::kStraight) sum_m += piece.profile.way();
    if (piece.kind == Kind::kCurve) sum_m += limits_.speed_mps * piece.profile.duration_s();
  }
  return sum_m;
}

Pose2 DrivePlan::pose_in(const Piece& piece, double into_s, double way) const {
  if (piece.kind == Kind::kStraight) return compose(piece.from, {way, 0.0, 0.0});
  if (piece.kind == Kind::kSpot) return compose(piece.from, {0.0, 0.0, piece.sense * way});
  const Eigen::Vector2d gone_m = limits_.speed_mps * curve_offset(piece.profile, into_s);
  return compose(piece.from, {gone_m.x(), piece.sense * gone_m.y(), piece.sense * way});
}

DriveMoment DrivePlan::at(double t_s) const {
  const double clamped_s = std::clamp(t_s, 0.0, duration_s());
  const auto after =
      std::upper_bound(pieces_.begin() + 1, pieces_.end(), clamped_s,
                       [](double time_s, const Piece& piece) { return time_s < piece.start_s; });
  const Piece& piece = *(after - 1);
  const double into_s = std::min(clamped_s - piece.start_s, piece.profile.duration_s());
  const SpeedProfile::Moment moment = piece.profile.at(into_s);
  DriveMoment drive{pose_in(piece, into_s, moment.way), 0.0, 0.0};
  if (piece.kind != Kind::kSpot) {
    drive.speed_mps = piece.kind == Kind::kCurve ? limits_.speed_mps : moment.speed;
  }
  if (piece.kind != Kind::kStraight) drive.turn_radps = piece.sense * moment.speed;
  return drive;
}

}  // namespace roomwise::simulator
