#include "logs/tools/score_landmarks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "roomwise/landmark_observation_t.hpp"

namespace roomwise {
namespace {

using Observation = landmark_observation_t;

constexpr double kGate_m = 0.10;
constexpr double kGatePerRange = 0.02;
constexpr double kInSight_m = 0.05;

bool may_be(std::int8_t kind, std::int8_t true_kind) {
  switch (kind) {
    case Observation::KIND_EDGE_LEFT:
    case Observation::KIND_EDGE_RIGHT:
      return true_kind == Observation::KIND_CREASE_CONVEX || true_kind == Observation::KIND_POLE;
    case Observation::KIND_POLE:
      return true_kind == Observation::KIND_POLE || true_kind == Observation::KIND_CREASE_CONVEX;
    default:
      return kind == true_kind;
  }
}

std::optional<LandmarkMatch> match(const SeenLandmark& seen, const Pose2& T_world_robot,
                                   const std::vector<MapPoint>& truth) {
  const Eigen::Vector2d p_m = transform(T_world_robot, seen.p_robot_m);
  std::optional<LandmarkMatch> best;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector2d error_m = p_m - truth[i].p_m;
    if (!may_be(seen.kind, truth[i].kind)) continue;
    if (error_m.norm() > kGate_m + kGatePerRange * seen.p_robot_m.norm()) continue;
    if (best && best->error_m.norm() <= error_m.norm()) continue;
    best = LandmarkMatch{
        i, seen.kind, seen.utime, seen.p_robot_m.norm(), T_world_robot.position_m(), error_m};
  }
  return best;
}

bool is_in_sight(const MapPoint& landmark, const SeenFrame& frame, const Pose2& T_robot_world) {
  const Eigen::Vector2d p_robot_m = transform(T_robot_world, landmark.p_m);
  const double range_m = p_robot_m.norm();
  if (range_m < frame.range_min_m || range_m > frame.range_max_m) return false;
  return std::ranges::any_of(frame.scan_robot_m, [&](const Eigen::Vector2f& point_m) {
    return (point_m.cast<double>() - p_robot_m).squaredNorm() < kInSight_m * kInSight_m;
  });
}

/// Counts a frame's sightings and returns which true landmarks they show.
std::set<std::size_t> count_sightings(const SeenFrame& frame, const Pose2& T_world_robot,
                                      const std::vector<MapPoint>& truth, LandmarkScore& score) {
  std::set<std::size_t> shown;
  for (const SeenLandmark& seen : frame.landmarks) {
    if (seen.moving) {
      ++score.moving;
      continue;
    }
    ++score.seen;
    ++score.by_kind[seen.kind].seen;
    if (const auto found = match(seen, T_world_robot, truth)) {
      score.matches.push_back(*found);
      ++score.by_kind[seen.kind].matched;
      shown.insert(found->truth);
    }
  }
  return shown;
}

double ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// Sightings of one thing under one kind, in order of time.
using Histories = std::map<std::pair<std::size_t, std::int8_t>, std::vector<const LandmarkMatch*>>;

Histories histories(const std::vector<LandmarkMatch>& matches) {
  Histories result;
  for (const LandmarkMatch& m : matches) result[{m.truth, m.kind}].push_back(&m);
  return result;
}

}  // namespace

double LandmarkCounts::precision_ratio() const {
  return ratio(static_cast<double>(matched), static_cast<double>(seen));
}

LandmarkCounts LandmarkScore::of_kind(std::int8_t kind) const {
  const auto counts = by_kind.find(kind);
  return counts == by_kind.end() ? LandmarkCounts{} : counts->second;
}

double LandmarkScore::precision_ratio() const {
  return ratio(static_cast<double>(matches.size()), static_cast<double>(seen));
}

double LandmarkScore::found_ratio() const {
  return ratio(static_cast<double>(found), static_cast<double>(in_sight));
}

double LandmarkScore::false_per_frame() const {
  return ratio(static_cast<double>(seen - matches.size()), static_cast<double>(frames));
}

double LandmarkScore::error_rms_m() const {
  double squares_m2 = 0.0;
  for (const LandmarkMatch& m : matches) squares_m2 += m.error_m.squaredNorm();
  return std::sqrt(ratio(squares_m2, static_cast<double>(matches.size())));
}

double LandmarkScore::repeat_std_m(double least_m, double most_m) const {
  constexpr std::int64_t kApart_us = 150'000;
  double squares_m2 = 0.0;
  double pairs = 0.0;
  for (const auto& [what, history] : histories(matches)) {
    for (std::size_t i = 1; i < history.size(); ++i) {
      const LandmarkMatch& a = *history[i - 1];
      const LandmarkMatch& b = *history[i];
      if (a.utime == b.utime || b.utime - a.utime > kApart_us) continue;
      if (b.range_m < least_m || b.range_m >= most_m) continue;
      squares_m2 += (b.error_m - a.error_m).squaredNorm();
      pairs += 1.0;
    }
  }
  // Two coordinates, two sightings: the standard deviation of one coordinate of one sighting.
  return std::sqrt(ratio(squares_m2, 4.0 * pairs));
}

double LandmarkScore::viewpoint_median_m() const {
  constexpr double kApart_m = 0.5;
  std::vector<double> distances_m;
  for (const auto& [what, history] : histories(matches)) {
    const LandmarkMatch& first = *history.front();
    for (const LandmarkMatch* m : history) {
      const bool is_far = (m->p_robot_m - first.p_robot_m).norm() >= kApart_m;
      if (is_far) distances_m.push_back((m->error_m - first.error_m).norm());
    }
  }
  if (distances_m.empty()) return 0.0;
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  return *middle;
}

LandmarkScore score_landmarks(const Recording& recording) {
  LandmarkScore score;
  for (const SeenFrame& frame : recording.seen_frames) {
    const auto pose = pose_at(recording.truth, frame.utime);
    if (!pose) continue;
    ++score.frames;
    const auto shown = count_sightings(frame, *pose, recording.true_landmarks, score);
    const Pose2 T_robot_world = inverse(*pose);
    for (std::size_t i = 0; i < recording.true_landmarks.size(); ++i) {
      if (!is_in_sight(recording.true_landmarks[i], frame, T_robot_world)) continue;
      ++score.in_sight;
      if (shown.contains(i)) ++score.found;
    }
  }
  return score;
}

}  // namespace roomwise
