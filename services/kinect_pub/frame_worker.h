#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "common/frames/frame_encoder.h"
#include "roomwise/kinect_frame_t.hpp"
#include "services/kinect_pub/core/kinect_params.h"
#include "services/kinect_pub/device/captured_frame.h"
#include "services/kinect_pub/device/latest_slot.h"

namespace roomwise {

/// Makes a KINECT_FRAME message of a captured frame. Keeps its buffers.
class FrameToMessage {
 public:
  explicit FrameToMessage(const kinect::KinectParams& params);

  /// Cleans `frame`'s depth in place, encodes it and fills `message` but for its seq.
  void convert(CapturedFrame& frame, kinect_frame_t& message);

 private:
  kinect::KinectParams params_;
  std::int8_t depth_encoding_;
  std::int8_t color_encoding_;
  PinholeCamera own_depth_camera_;
  PinholeCamera own_color_camera_;
  Eigen::Isometry3d T_robot_camera_;
  FrameEncoder encoder_;
  std::vector<std::uint8_t> players_;  // of the frame in hand
};

/// A thread that takes captured frames and turns the newest into a message.
class FrameWorker {
 public:
  /// What encoding cost since the last take_cost().
  struct Cost {
    std::int64_t frames = 0;
    std::int64_t sum_us = 0;
    std::int64_t max_us = 0;
  };

  /// `ready` is called on the worker's thread each time a message lies in `messages`.
  FrameWorker(const kinect::KinectParams& params, LatestSlot<CapturedFrame>& frames,
              LatestSlot<kinect_frame_t>& messages, std::function<void()> ready);
  FrameWorker(const FrameWorker&) = delete;
  FrameWorker& operator=(const FrameWorker&) = delete;
  ~FrameWorker();

  Cost take_cost();

  /// Messages nobody had sent when the next was ready.
  std::int64_t dropped() const;

 private:
  void run();
  void account(std::int64_t cost_us, bool dropped);

  FrameToMessage to_message_;
  LatestSlot<CapturedFrame>& frames_;
  LatestSlot<kinect_frame_t>& messages_;
  const std::function<void()> ready_;
  mutable std::mutex mutex_;
  Cost cost_;
  std::int64_t dropped_ = 0;
  std::thread thread_;
};

}  // namespace roomwise
