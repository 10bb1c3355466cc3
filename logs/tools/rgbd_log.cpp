#include "logs/tools/rgbd_log.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/channels.h"
#include "logs/tools/camera_pose.h"

namespace roomwise {
namespace {

void set_color(const JpegImage& color, kinect_frame_t& message) {
  if (color.bytes.empty()) return;  // a message starts without
  message.color_encoding = kinect_frame_t::COLOR_JPEG;
  message.color_width_px = color.width_px;
  message.color_height_px = color.height_px;
  message.color_size = static_cast<std::int32_t>(color.bytes.size());
  message.color_data = color.bytes;
}

void set_robot(const Pose2& T_world_robot, truth_t& truth) {
  truth.true_x_m = T_world_robot.x_m;
  truth.true_y_m = T_world_robot.y_m;
  truth.true_heading_rad = T_world_robot.heading_rad;
}

void set_camera(const Eigen::Isometry3d& T_world_camera, truth_t& truth) {
  truth.has_camera_pose = 1;
  const Eigen::Vector3d p = T_world_camera.translation();
  std::copy(p.begin(), p.end(), truth.T_world_camera_translation_m);
  Eigen::Quaterniond q(T_world_camera.linear());
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(std::begin(wxyz), std::end(wxyz), truth.T_world_camera_quat);
}

}  // namespace

void RgbdLog::write_frame(const ImportedFrame& frame, const std::filesystem::path& source) {
  kinect_frame_t message{};
  message.utime = frame.utime;
  message.seq = frame.seq;
  message.device_time_us = frame.device_time_us;
  message.depth_registered = frame.depth_registered ? 1 : 0;
  encoder_.encode_depth(frame.depth, kinect_frame_t::DEPTH_PDZ16, message);
  set_color(frame.color, message);
  encode_depth_camera(frame.camera, message);
  if (!frame.color.bytes.empty()) {
    encode_color_camera(frame.color_camera.value_or(frame.camera), message);
  }
  encode_pose(frame.T_robot_camera, message);
  const FrameResult result = check_.decode(message, decoded_);
  if (result != FrameResult::kOk) {
    throw std::runtime_error(fmt::format("{}: {}", source.string(), counter_name(result)));
  }
  log_.write(channels::kKinectFrame, time_from_utime(frame.utime), message);
}

void RgbdLog::write_truth(std::int64_t utime, const Eigen::Isometry3d& T_world_camera) {
  truth_t truth{};
  truth.utime = utime;
  truth.seq = ++truth_seq_;
  set_robot(robot_below(T_world_camera), truth);
  set_camera(T_world_camera, truth);
  log_.write(channels::kTruth, time_from_utime(utime), truth);
}

}  // namespace roomwise
