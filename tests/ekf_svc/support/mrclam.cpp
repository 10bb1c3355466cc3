#include "tests/ekf_svc/support/mrclam.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "common/bus/wire.h"
#include "common/channels.h"

namespace roomwise::mrclam {
namespace {

std::vector<std::vector<double>> read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::vector<double> row;
    for (double value = 0.0; words >> value;) row.push_back(value);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

std::int64_t utime_of_seconds(double time_s) { return std::llround(time_s * 1e6); }

template <class Message>
LogEvent event_of(const Channel<Message>& channel, const Message& message) {
  LogEvent event{time_from_utime(message.utime), std::string(channel.name), {}};
  encode(message, event.data);
  return event;
}

void add_odometry(const std::vector<std::vector<double>>& rows, const Noise& noise, Run& run) {
  Pose2 odom;
  odometry_t message{};
  message.source = odometry_t::SOURCE_VELOCITY;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const std::int64_t begin = utime_of_seconds(rows[i][0]);
    const std::int64_t end = utime_of_seconds(rows[i + 1][0]);
    if (end <= begin) continue;
    const double time_s = static_cast<double>(end - begin) * 1e-6;
    const double distance = rows[i][1] * time_s;
    const double turn = rows[i][2] * time_s;
    const double half = 0.5 * turn;
    const double chord = distance * (std::abs(half) > 1e-9 ? std::sin(half) / half : 1.0);
    odom = compose(odom, {chord * std::cos(half), chord * std::sin(half), turn});
    message.utime = end + utime_of_seconds(noise.odometry_delay_s);
    message.seq++;
    message.interval_us = end - begin;
    message.distance_increment_m = distance;
    message.turn_increment_rad = turn;
    message.covariance_distance_distance_m2 = noise.distance_m2_per_m * std::abs(distance);
    message.covariance_turn_turn_rad2 =
        noise.turn_rad2_per_rad * std::abs(turn) + noise.turn_rad2_per_m * std::abs(distance);
    message.x_m = odom.x_m;
    message.y_m = odom.y_m;
    message.heading_rad = odom.heading_rad;
    run.events.push_back(event_of(channels::kOdometry, message));
  }
}

landmark_observation_t observation(int subject, double range_m, double bearing_rad,
                                   const Noise& noise) {
  const double range_sigma = noise.range_m + noise.range_ratio * range_m;
  landmark_observation_t seen{};
  seen.identity = subject;
  seen.kind = landmark_observation_t::KIND_FIDUCIAL;
  seen.range_m = range_m;
  seen.bearing_rad = bearing_rad;
  seen.covariance_range_range_m2 = range_sigma * range_sigma;
  seen.covariance_bearing_bearing_rad2 = noise.bearing_rad * noise.bearing_rad;
  seen.chroma_variance_log2 = 1e6;
  seen.score_ratio = 1.0;
  return seen;
}

void add_sightings(const std::vector<std::vector<double>>& rows,
                   const std::map<int, int>& subject_of, const Noise& noise, Run& run) {
  constexpr int kRobots = 5;
  std::map<std::int64_t, landmark_list_t> lists;
  for (const auto& row : rows) {
    const auto subject = subject_of.find(static_cast<int>(row[1]));
    if (subject == subject_of.end() || subject->second <= kRobots) continue;
    landmark_list_t& list = lists[utime_of_seconds(row[0])];
    list.landmarks.push_back(observation(subject->second, row[2], row[3], noise));
  }
  std::int64_t seq = 0;
  for (auto& [utime, list] : lists) {
    list.utime = utime;
    list.seq = ++seq;
    list.count = static_cast<std::int32_t>(list.landmarks.size());
    run.events.push_back(event_of(channels::kLandmarks, list));
  }
}

}  // namespace

Run read(const std::filesystem::path& folder, int robot, const Noise& noise) {
  const std::string prefix = "Robot" + std::to_string(robot) + "_";
  std::map<int, int> subject_of;
  for (const auto& row : read_table(folder / "Barcodes.dat")) {
    subject_of[static_cast<int>(row[1])] = static_cast<int>(row[0]);
  }
  Run run;
  add_odometry(read_table(folder / (prefix + "Odometry.dat")), noise, run);
  add_sightings(read_table(folder / (prefix + "Measurement.dat")), subject_of, noise, run);
  std::stable_sort(run.events.begin(), run.events.end(),
                   [](const LogEvent& a, const LogEvent& b) { return a.time < b.time; });
  for (const auto& row : read_table(folder / (prefix + "Groundtruth.dat"))) {
    run.truth[utime_of_seconds(row[0])] = {row[1], row[2], wrap_angle(row[3])};
  }
  for (const auto& row : read_table(folder / "Landmark_Groundtruth.dat")) {
    run.landmarks[static_cast<int>(row[0])] = {row[1], row[2]};
  }
  return run;
}

bool truth_at(const Run& run, std::int64_t utime, Pose2& pose) {
  const auto after = run.truth.lower_bound(utime);
  if (after == run.truth.end() || after == run.truth.begin()) return false;
  const auto before = std::prev(after);
  const double ratio = static_cast<double>(utime - before->first) /
                       static_cast<double>(after->first - before->first);
  const Pose2& a = before->second;
  const Pose2& b = after->second;
  pose = {a.x_m + ratio * (b.x_m - a.x_m), a.y_m + ratio * (b.y_m - a.y_m),
          wrap_angle(a.heading_rad + ratio * wrap_angle(b.heading_rad - a.heading_rad))};
  return true;
}

Pose2 rigid_fit(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to) {
  Eigen::Vector2d from_mean = Eigen::Vector2d::Zero(), to_mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) from_mean += from[i], to_mean += to[i];
  from_mean /= static_cast<double>(from.size());
  to_mean /= static_cast<double>(from.size());
  double dot = 0.0, cross = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d a = from[i] - from_mean, b = to[i] - to_mean;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
  }
  const double turn = std::atan2(cross, dot);
  const Eigen::Vector2d shift = to_mean - rotation2(turn) * from_mean;
  return {shift.x(), shift.y(), turn};
}

double aligned_rmse(const std::vector<Eigen::Vector2d>& from,
                    const std::vector<Eigen::Vector2d>& to) {
  const Pose2 fit = rigid_fit(from, to);
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
    sum += (transform(fit, from[i]) - to[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(from.size()));
}

}  // namespace roomwise::mrclam
