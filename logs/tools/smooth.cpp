#include "logs/tools/smooth.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <stdexcept>

#include "common/bus/bus.h"
#include "common/bus/log_file.h"
#include "logs/tools/batch_smoother.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/trajectory.h"
#include "logs/tools/whole_file.h"
#include "services/ekf_svc/core/body_observation.h"

namespace roomwise {
namespace {

constexpr std::int64_t kNodeEvery_us = 250'000;
constexpr double kNearestMax_m = 0.5;  // from a sighting of unknown identity to its landmark

/// What of the log the problem is made of.
struct Drive {
  std::vector<odometry_t> odometry;
  std::map<std::int64_t, landmark_list_t> frames;  // by utime
  Trajectory poses;
  pose_t last_pose{};
  landmark_map_t map{};
};

Drive read_drive(const std::filesystem::path& log) {
  Drive drive;
  const LogReading reading = replay_log(log, [&](Bus& bus) {
    bus.subscribe(channels::kOdometry, [&](const odometry_t& m) {
      const bool is_later = drive.odometry.empty() || m.utime > drive.odometry.back().utime;
      if (is_later) drive.odometry.push_back(m);
    });
    bus.subscribe(channels::kLandmarks,
                  [&](const landmark_list_t& m) { drive.frames.emplace(m.utime, m); });
    bus.subscribe(channels::kPose, [&](const pose_t& m) {
      drive.last_pose = m;
      drive.poses.push_back({m.utime, {m.x_m, m.y_m, m.heading_rad}});
    });
    bus.subscribe(channels::kLandmarkMap, [&](const landmark_map_t& m) { drive.map = m; });
  });
  reading.raise_complaints(log);
  const bool is_whole = drive.odometry.size() > 1 && !drive.frames.empty() &&
                        drive.poses.size() > 1 && !drive.map.map_landmarks.empty();
  if (!is_whole) {
    throw std::runtime_error(log.string() +
                             ": needs ODOMETRY, LANDMARKS, POSE and LANDMARK_MAP; run ekf_svc "
                             "--replay on it first");
  }
  return drive;
}

/// Where nodes lie: at every frame, and often enough between them.
std::vector<std::int64_t> node_times(const Drive& drive) {
  const std::int64_t first = std::max(drive.odometry.front().utime, drive.poses.front().utime);
  const std::int64_t last = std::min(drive.odometry.back().utime, drive.poses.back().utime);
  std::vector<std::int64_t> times;
  for (std::int64_t t = first; t <= last; t += kNodeEvery_us) times.push_back(t);
  for (const auto& [utime, frame] : drive.frames) {
    if (utime > first && utime < last) times.push_back(utime);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Motion between nodes, odometry's steps cut where a node lies.
void add_motions(const Drive& drive, SmoothProblem& problem) {
  problem.motions.resize(problem.utimes.size() - 1);
  std::size_t node = 0;
  for (std::size_t i = 1; i < drive.odometry.size(); ++i) {
    const odometry_t& report = drive.odometry[i];
    std::int64_t begin = drive.odometry[i - 1].utime;
    Eigen::Matrix2d covariance;
    covariance << report.covariance_distance_distance_m2, report.covariance_distance_turn_m_rad,
        report.covariance_distance_turn_m_rad, report.covariance_turn_turn_rad2;
    const auto step =
        report.source == odometry_t::SOURCE_VELOCITY ? ekf::speed_step : ekf::arc_step;
    const ekf::MotionStep whole =
        step(report.distance_increment_m, report.turn_increment_rad, covariance);
    const auto length_us = static_cast<double>(report.utime - begin);
    while (begin < report.utime && node < problem.motions.size()) {
      if (begin < problem.utimes[node]) {
        begin = std::min(report.utime, problem.utimes[node]);
        continue;
      }
      const std::int64_t end = std::min(report.utime, problem.utimes[node + 1]);
      const double share = static_cast<double>(end - begin) / length_us;
      problem.motions[node].append(ekf::part_of(whole, share), problem.calibration);
      begin = end;
      if (end == problem.utimes[node + 1]) ++node;
    }
  }
}

std::size_t landmark_of(const landmark_map_t& map, const landmark_observation_t& seen,
                        const Eigen::Vector2d& p_map_m) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t best = kNone;
  double best_m2 =
      seen.identity >= 0 ? std::numeric_limits<double>::infinity() : kNearestMax_m * kNearestMax_m;
  for (std::size_t l = 0; l < map.map_landmarks.size(); ++l) {
    const map_landmark_t& landmark = map.map_landmarks[l];
    if (landmark.identity != seen.identity || landmark.kind != seen.kind) continue;
    const double distance_m2 =
        (Eigen::Vector2d(landmark.map_x_m, landmark.map_y_m) - p_map_m).squaredNorm();
    if (distance_m2 > best_m2) continue;
    best = l;
    best_m2 = distance_m2;
  }
  return best;
}

void add_sightings(const Drive& drive, SmoothProblem& problem) {
  for (std::size_t node = 0; node < problem.utimes.size(); ++node) {
    const auto frame = drive.frames.find(problem.utimes[node]);
    if (frame == drive.frames.end()) continue;
    for (const landmark_observation_t& seen : frame->second.landmarks) {
      ekf::PolarObservation polar{seen.range_m, seen.bearing_rad, {}};
      polar.covariance << seen.covariance_range_range_m2, seen.covariance_range_bearing_m_rad,
          seen.covariance_range_bearing_m_rad, seen.covariance_bearing_bearing_rad2;
      const ekf::BodyObservation body = ekf::to_body(polar, 0.0, 0.0);
      const std::size_t l =
          landmark_of(drive.map, seen, transform(problem.poses[node], body.p_robot_m));
      if (l >= drive.map.map_landmarks.size() || seen.moving != 0) continue;
      problem.sightings.push_back({node, l, body.p_robot_m, body.covariance_m2});
    }
  }
}

SmoothProblem problem_of(const Drive& drive) {
  SmoothProblem problem;
  problem.calibration.value << drive.last_pose.distance_scale_ratio - 1.0,
      drive.last_pose.turn_scale_ratio - 1.0, drive.last_pose.turn_per_distance_rad_per_m;
  for (const std::int64_t utime : node_times(drive)) {
    const auto pose = pose_at(drive.poses, utime);
    if (!pose) continue;
    problem.utimes.push_back(utime);
    problem.poses.push_back(*pose);
  }
  for (const map_landmark_t& landmark : drive.map.map_landmarks) {
    problem.landmarks_m.emplace_back(landmark.map_x_m, landmark.map_y_m);
  }
  add_motions(drive, problem);
  add_sightings(drive, problem);
  return problem;
}

pose_t smoothed_pose(const Drive& drive, const SmoothProblem& problem, std::size_t node) {
  pose_t message = drive.last_pose;
  message.utime = problem.utimes[node];
  message.seq = static_cast<std::int64_t>(node) + 1;
  message.x_m = problem.poses[node].x_m;
  message.y_m = problem.poses[node].y_m;
  message.heading_rad = problem.poses[node].heading_rad;
  message.distance_scale_ratio = 1.0 + problem.calibration.distance_ratio();
  message.turn_scale_ratio = 1.0 + problem.calibration.turn_ratio();
  message.turn_per_distance_rad_per_m = problem.calibration.turn_per_distance_rad_per_m();
  return message;
}

void write_smoothed(const SmoothOptions& options, const Drive& drive,
                    const SmoothProblem& problem) {
  ReplacedFile file(options.out);
  LogWriter writer(file.temporary());
  LogReader reader(options.log);
  LogEvent event;
  while (reader.next(event)) {
    const bool is_replaced =
        event.channel == channels::kPose.name || event.channel == channels::kLandmarkMap.name;
    if (!is_replaced) writer.write(event);
  }
  for (std::size_t node = 0; node < problem.utimes.size(); ++node) {
    writer.write(channels::kPose, event.time, smoothed_pose(drive, problem, node));
  }
  landmark_map_t map = drive.map;
  for (std::size_t l = 0; l < map.map_landmarks.size(); ++l) {
    map.map_landmarks[l].map_x_m = problem.landmarks_m[l].x();
    map.map_landmarks[l].map_y_m = problem.landmarks_m[l].y();
  }
  writer.write(channels::kLandmarkMap, event.time, map);
  writer.close();
  file.commit();
}

}  // namespace

void smooth_log(const SmoothOptions& options, std::ostream& notes) {
  const Drive drive = read_drive(options.log);
  SmoothProblem problem = problem_of(drive);
  const SmoothReport report = smooth(problem);
  fmt::print(notes, "nodes {}\nsightings {}\nlandmarks {}\n", problem.utimes.size(),
             problem.sightings.size(), problem.landmarks_m.size());
  fmt::print(notes, "cost {:.1f} -> {:.1f} in {} iterations, {}\n", report.cost_before,
             report.cost_after, report.iterations,
             report.converged ? "converged" : "NOT converged");
  fmt::print(notes, "distance scale {:.4f}\nturn scale {:.4f}\nturn per distance {:.4f} rad/m\n",
             1.0 + problem.calibration.distance_ratio(), 1.0 + problem.calibration.turn_ratio(),
             problem.calibration.turn_per_distance_rad_per_m());
  fmt::print(notes,
             "lost in curves {:.4f} m/rad\nranges over the view: tilt {:.4f}, curvature"
             " {:.4f}\n",
             problem.calibration.turn_loss_m_per_rad, problem.ranges.value.x(),
             problem.ranges.value.y());
  write_smoothed(options, drive, problem);
}

void add_smooth(CLI::App& parent) {
  CLI::App& command =
      *parent.add_subcommand("smooth", "The best estimate of path and map in hindsight.");
  const auto options = std::make_shared<SmoothOptions>();
  command.add_option("LOG", options->log, "a log with what ekf_svc made of it")->required();
  command.add_option("-o", options->out, "log to write")->required();
  command.callback([options] { smooth_log(*options, std::cout); });
}

}  // namespace roomwise
