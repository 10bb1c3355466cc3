#include "services/kinect_pub/frame_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "services/kinect_pub/core/camera_geometry.h"
#include "services/kinect_pub/core/depth_words.h"

namespace roomwise {

FrameToMessage::FrameToMessage(const kinect::KinectParams& params)
    : params_(params),
      depth_encoding_(params.depth_encoding == "pdz16" ? kinect_frame_t::DEPTH_PDZ16
                                                       : kinect_frame_t::DEPTH_RAW16),
      color_encoding_(params.color_encoding == "jpeg" ? kinect_frame_t::COLOR_JPEG
                                                      : kinect_frame_t::COLOR_RGB8),
      own_depth_camera_{params.depth_fx_px, params.depth_fy_px, params.depth_cx_px,
                        params.depth_cy_px},
      own_color_camera_{params.color_fx_px, params.color_fy_px, params.color_cx_px,
                        params.color_cy_px},
      T_robot_camera_(kinect::camera_on_robot(params)) {}

void FrameToMessage::convert(CapturedFrame& frame, kinect_frame_t& message) {
  const bool own = params_.use_own_intrinsics;
  const int steps_per_mm = frame.depth.unit_m < 5e-4 ? 10 : 1;
  const bool has_players = params_.depth_words == "depth_and_player";
  if (has_players) {
    players_.resize(frame.depth.size());
    kinect::split_players(frame.depth.steps, players_);
  }
  kinect::drop_depths_above(std::min(params_.depth_max_mm * steps_per_mm, 65534),
                            frame.depth.steps);
  message.utime = frame.utime;
  message.device_time_us = frame.device_time_us;
  message.depth_registered = frame.depth_registered ? 1 : 0;
  if (has_players) {
    encoder_.encode_depth_and_players(frame.depth, players_, message);
  } else {
    encoder_.encode_depth(frame.depth, depth_encoding_, message);
  }
  encoder_.encode_color(frame.color, color_encoding_, params_.jpeg_quality, message);
  encode_depth_camera(own ? own_depth_camera_ : frame.depth_camera, message);
  encode_color_camera(own ? own_color_camera_ : frame.color_camera, message);
  encode_pose(T_robot_camera_, message);
}

FrameWorker::FrameWorker(const kinect::KinectParams& params, LatestSlot<CapturedFrame>& frames,
                         LatestSlot<kinect_frame_t>& messages, std::function<void()> ready)
    : to_message_(params),
      frames_(frames),
      messages_(messages),
      ready_(std::move(ready)),
      thread_([this] { run(); }) {}

FrameWorker::~FrameWorker() {
  frames_.close();
  thread_.join();
}

void FrameWorker::run() {
  using std::chrono::steady_clock;
  CapturedFrame frame;
  kinect_frame_t message{};
  while (frames_.take(frame)) {
    const auto start = steady_clock::now();
    to_message_.convert(frame, message);
    const auto cost =
        std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now() - start);
    account(cost.count(), messages_.put(message));
    ready_();
  }
}

void FrameWorker::account(std::int64_t cost_us, bool dropped) {
  const std::lock_guard lock(mutex_);
  ++cost_.frames;
  cost_.sum_us += cost_us;
  cost_.max_us = std::max(cost_.max_us, cost_us);
  dropped_ += dropped ? 1 : 0;
}

FrameWorker::Cost FrameWorker::take_cost() {
  const std::lock_guard lock(mutex_);
  return std::exchange(cost_, {});
}

std::int64_t FrameWorker::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace roomwise
