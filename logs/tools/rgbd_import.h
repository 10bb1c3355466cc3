#pragma once
#include <cstdint>

#include "common/frames/frame_encoder.h"
#include "common/image/rgbd_frame.h"
#include "logs/tools/image_file.h"
#include "roomwise/kinect_frame_t.hpp"
#include "roomwise/truth_t.hpp"

namespace roomwise {

/// One instant of a recorded depth camera, as import finds it: depth registered to colour, one
/// pinhole camera for both.
struct ImportedFrame {
  std::int64_t utime = 0;
  std::int64_t seq = 0;
  std::int64_t device_time_us = 0;
  DepthImage depth;
  JpegImage color;
  PinholeCamera camera;
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
};

kinect_frame_t frame_message(const ImportedFrame& frame, FrameEncoder& encoder);

/// TRUTH of a camera: its pose, and the pose of the robot below it. The world's z points up.
truth_t truth_message(std::int64_t utime, std::int64_t seq,
                      const Eigen::Isometry3d& T_world_camera);

}  // namespace roomwise
