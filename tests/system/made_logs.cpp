#include "tests/system/made_logs.h"

#include <cmath>

#include "common/bus/log_file.h"
#include "common/frames/frame_encoder.h"
#include "tests/support/events.h"
#include "tests/support/synthetic_room.h"

namespace roomwise {
namespace {

constexpr std::int64_t kStart_utime = 1'600'000'000'000'000;

kinect_frame_t frame_message(const RgbdFrame& frame, FrameEncoder& encoder) {
  kinect_frame_t message{};
  encoder.encode_depth(frame.depth, kinect_frame_t::DEPTH_PDZ16, message);
  constexpr int kJpegQuality = 85;
  encoder.encode_color(frame.color, kinect_frame_t::COLOR_JPEG, kJpegQuality, message);
  encode_depth_camera(frame.depth_camera, message);
  encode_color_camera(frame.color_camera, message);
  encode_pose(frame.T_robot_camera, message);
  message.depth_registered = 1;
  return message;
}

odometry_t odometry_step(std::int64_t utime, double distance_m, double turn_rad, Pose2& pose) {
  const double half_rad = 0.5 * turn_rad;
  pose =
      compose(pose, {distance_m * std::cos(half_rad), distance_m * std::sin(half_rad), turn_rad});
  odometry_t odometry{};
  odometry.utime = utime;
  odometry.interval_us = 20'000;
  odometry.source = odometry_t::SOURCE_BODY;
  odometry.distance_increment_m = distance_m;
  odometry.turn_increment_rad = turn_rad;
  odometry.covariance_distance_distance_m2 = 1e-6;
  odometry.covariance_turn_turn_rad2 = 1e-6;
  odometry.x_m = pose.x_m;
  odometry.y_m = pose.y_m;
  odometry.heading_rad = pose.heading_rad;
  return odometry;
}

landmark_list_t landmarks_from(std::int64_t utime, const Pose2& T_world_robot) {
  landmark_list_t list{};
  list.utime = utime;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector2d landmark_m(1.0 + i, i % 2 == 0 ? 1.0 : -1.0);
    const Eigen::Vector2d seen_m = transform(inverse(T_world_robot), landmark_m);
    landmark_observation_t seen{};
    seen.identity = i;
    seen.kind = landmark_observation_t::KIND_FIDUCIAL;
    seen.range_m = seen_m.norm();
    seen.bearing_rad = std::atan2(seen_m.y(), seen_m.x());
    seen.covariance_range_range_m2 = 1e-4;
    seen.covariance_bearing_bearing_rad2 = 1e-4;
    seen.chroma_variance_log2 = 1e6;
    list.landmarks.push_back(seen);
  }
  list.count = static_cast<std::int32_t>(list.landmarks.size());
  return list;
}

}  // namespace

std::vector<LogEvent> made_frames() {
  const SyntheticCamera camera{.width_px = 320, .height_px = 240, .pitch_rad = 0.1};
  FrameEncoder encoder;
  std::vector<LogEvent> events;
  for (int i = 0; i < 10; ++i) {
    const Pose2 T_world_robot{0.0, 0.0, -0.1 + 0.02 * i};
    kinect_frame_t message = frame_message(
        render(furnished_room(), camera, T_world_robot, static_cast<std::uint32_t>(i)), encoder);
    message.utime = kStart_utime + 200'000 * i;
    message.seq = i + 1;
    events.push_back(event_of(channels::kKinectFrame, message.utime, message));
  }
  return events;
}

std::vector<LogEvent> made_drive() {
  std::vector<LogEvent> events;
  Pose2 pose;
  for (int i = 1; i <= 150; ++i) {
    const std::int64_t utime = kStart_utime + 20'000 * i;
    odometry_t odometry = odometry_step(utime, 0.005, 0.002, pose);
    odometry.seq = i;
    events.push_back(event_of(channels::kOdometry, utime, odometry));
    if (i % 5 != 0) continue;
    landmark_list_t landmarks = landmarks_from(utime, pose);
    landmarks.seq = i / 5;
    events.push_back(event_of(channels::kLandmarks, utime, landmarks));
  }
  return events;
}

void write_log(const std::filesystem::path& path, const std::vector<LogEvent>& events) {
  LogWriter writer(path);
  for (const LogEvent& event : events) writer.write(event);
  writer.close();
}

}  // namespace roomwise
