#include "logs/tools/mrclam_messages.h"

#include <cmath>

#include "common/geometry/pose2.h"

namespace roomwise {
namespace {

constexpr int kLastRobotSubject = 5;
constexpr double kNoColor_variance_log2 = 1e6;
constexpr std::int64_t kTrueLandmarksEvery_us = 1000000;

/// Along a circular arc, exactly: the chord at mid heading.
Pose2 drive_arc(const Pose2& from, double distance_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  const double chord_ratio = std::abs(half_rad) < 1e-6 ? 1.0 : std::sin(half_rad) / half_rad;
  const double mid_rad = from.heading_rad + half_rad;
  return {from.x_m + distance_m * chord_ratio * std::cos(mid_rad),
          from.y_m + distance_m * chord_ratio * std::sin(mid_rad),
          wrap_angle(from.heading_rad + turn_rad)};
}

odometry_t odometry_message(const MrclamImport& import, double distance_m, double turn_rad) {
  odometry_t message{};
  message.source = odometry_t::SOURCE_VELOCITY;
  message.distance_increment_m = distance_m;
  message.turn_increment_rad = turn_rad;
  message.covariance_distance_distance_m2 =
      import.distance_variance_m2_per_m * std::abs(distance_m);
  message.covariance_turn_turn_rad2 = import.turn_variance_rad2_per_rad * std::abs(turn_rad) +
                                      import.turn_variance_rad2_per_m * std::abs(distance_m);
  return message;
}

landmark_observation_t observation(const MrclamImport& import, const MrclamMeasurement& seen,
                                   int subject) {
  landmark_observation_t landmark{};
  landmark.identity = import.unknown_identities ? -1 : subject;
  landmark.kind = import.unknown_identities ? landmark_observation_t::KIND_POLE
                                            : landmark_observation_t::KIND_FIDUCIAL;
  landmark.range_m = seen.range_m;
  landmark.bearing_rad = wrap_angle(seen.bearing_rad);
  const double range_sigma_m = import.range_sigma_m + import.range_sigma_per_m * seen.range_m;
  landmark.covariance_range_range_m2 = range_sigma_m * range_sigma_m;
  landmark.covariance_bearing_bearing_rad2 = import.bearing_sigma_rad * import.bearing_sigma_rad;
  landmark.chroma_variance_log2 = kNoColor_variance_log2;
  landmark.score_ratio = 1.0;
  return landmark;
}

std::vector<true_landmark_t> true_landmarks(const MrclamFiles& files) {
  std::vector<true_landmark_t> landmarks;
  for (const auto& [subject, point] : files.landmarks) {
    true_landmark_t landmark{};
    landmark.identity = subject;
    landmark.kind = landmark_observation_t::KIND_FIDUCIAL;
    landmark.true_x_m = point.x_m;
    landmark.true_y_m = point.y_m;
    landmarks.push_back(landmark);
  }
  return landmarks;
}

}  // namespace

std::vector<odometry_t> odometry_messages(const MrclamImport& import,
                                          const std::vector<MrclamVelocity>& velocities) {
  std::vector<odometry_t> messages;
  Pose2 T_odom_robot;
  const auto delay_us = static_cast<std::int64_t>(import.odometry_delay_s * 1e6);
  for (std::size_t i = 0; i + 1 < velocities.size(); ++i) {
    const MrclamVelocity& held = velocities[i];
    const std::int64_t interval_us = velocities[i + 1].utime - held.utime;
    if (interval_us == 0) continue;
    const double interval_s = static_cast<double>(interval_us) * 1e-6;
    const double distance_m = held.speed_mps * interval_s;
    const double turn_rad = held.turn_rate_radps * interval_s;
    T_odom_robot = drive_arc(T_odom_robot, distance_m, turn_rad);
    odometry_t message = odometry_message(import, distance_m, turn_rad);
    message.utime = velocities[i + 1].utime + delay_us;
    message.seq = static_cast<std::int64_t>(messages.size()) + 1;
    message.interval_us = interval_us;
    message.x_m = T_odom_robot.x_m;
    message.y_m = T_odom_robot.y_m;
    message.heading_rad = T_odom_robot.heading_rad;
    messages.push_back(message);
  }
  return messages;
}

MrclamSightings landmark_messages(const MrclamImport& import, const MrclamFiles& files) {
  MrclamSightings sightings;
  for (const MrclamMeasurement& seen : files.measurements) {
    const auto subject = files.subject_of_barcode.find(seen.barcode);
    if (subject == files.subject_of_barcode.end()) {
      ++sightings.unknown_barcodes;
      continue;
    }
    if (subject->second <= kLastRobotSubject) {
      ++sightings.other_robots;
      continue;
    }
    if (sightings.messages.empty() || sightings.messages.back().utime != seen.utime) {
      landmark_list_t message{};
      message.utime = seen.utime;
      message.seq = static_cast<std::int64_t>(sightings.messages.size()) + 1;
      sightings.messages.push_back(message);
    }
    landmark_list_t& message = sightings.messages.back();
    message.landmarks.push_back(observation(import, seen, subject->second));
    ++message.count;
    ++sightings.landmarks;
  }
  return sightings;
}

std::vector<truth_t> truth_messages(const MrclamFiles& files) {
  const std::vector<true_landmark_t> landmarks = true_landmarks(files);
  std::vector<truth_t> messages;
  std::int64_t landmarks_due_utime = 0;
  for (const MrclamPose& pose : files.truth) {
    truth_t message{};
    message.utime = pose.utime;
    message.seq = static_cast<std::int64_t>(messages.size()) + 1;
    message.true_x_m = pose.x_m;
    message.true_y_m = pose.y_m;
    message.true_heading_rad = wrap_angle(pose.heading_rad);
    message.T_world_camera_quat[0] = 1.0;
    if (pose.utime >= landmarks_due_utime) {
      message.true_landmarks = landmarks;
      message.landmark_count = static_cast<std::int32_t>(landmarks.size());
      landmarks_due_utime = pose.utime + kTrueLandmarksEvery_us;
    }
    messages.push_back(message);
  }
  return messages;
}

}  // namespace roomwise
