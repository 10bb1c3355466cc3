#include "logs/tools/rgbd_import.h"

#include <algorithm>

#include "logs/tools/camera_pose.h"

namespace roomwise {

kinect_frame_t frame_message(const ImportedFrame& frame, FrameEncoder& encoder) {
  kinect_frame_t message{};
  message.utime = frame.utime;
  message.seq = frame.seq;
  message.device_time_us = frame.device_time_us;
  message.depth_registered = 1;
  encoder.encode_depth(frame.depth, kinect_frame_t::DEPTH_PDZ16, message);
  message.color_encoding = kinect_frame_t::COLOR_JPEG;
  message.color_width_px = frame.color.width_px;
  message.color_height_px = frame.color.height_px;
  message.color_size = static_cast<std::int32_t>(frame.color.bytes.size());
  message.color_data = frame.color.bytes;
  encode_depth_camera(frame.camera, message);
  encode_color_camera(frame.camera, message);
  encode_pose(frame.T_robot_camera, message);
  return message;
}

truth_t truth_message(std::int64_t utime, std::int64_t seq,
                      const Eigen::Isometry3d& T_world_camera) {
  truth_t truth{};
  truth.utime = utime;
  truth.seq = seq;
  const Pose2 robot = robot_below(T_world_camera);
  truth.true_x_m = robot.x_m;
  truth.true_y_m = robot.y_m;
  truth.true_heading_rad = robot.heading_rad;
  truth.has_camera_pose = 1;
  const Eigen::Vector3d p = T_world_camera.translation();
  std::copy(p.begin(), p.end(), truth.T_world_camera_translation_m);
  Eigen::Quaterniond q(T_world_camera.linear());
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(std::begin(wxyz), std::end(wxyz), truth.T_world_camera_quat);
  return truth;
}

}  // namespace roomwise
