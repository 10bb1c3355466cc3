#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/bus/log_file.h"
#include "common/frames/frame_decoder.h"
#include "common/frames/frame_encoder.h"
#include "common/image/rgbd_frame.h"
#include "logs/tools/image_file.h"

namespace roomwise {

/// One instant of a recorded depth camera, as import finds it.
struct ImportedFrame {
  std::int64_t utime = 0;
  std::int64_t seq = 0;
  std::int64_t device_time_us = 0;
  DepthImage depth;
  bool depth_registered = false;  ///< depth pixels lie on the colour image's pixels
  JpegImage color;                ///< without bytes: none
  PinholeCamera camera;
  std::optional<PinholeCamera> color_camera;  ///< nothing: colour has the depth's
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
};

/// When recordings begin that do not say when they were made: 2013-01-01 00:00 UTC.
inline constexpr std::int64_t kUndated_utime = 1'356'998'400'000'000;

/// Writes KINECT_FRAME and TRUTH into a log.
class RgbdLog {
 public:
  explicit RgbdLog(LogWriter& log) : log_(log), check_(ColorUse::kDecode) {}

  /// Throws std::runtime_error naming `source` if no service could decode the frame.
  void write_frame(const ImportedFrame& frame, const std::filesystem::path& source);

  /// The camera's pose, and that of the robot below it. The world's z points up.
  void write_truth(std::int64_t utime, const Eigen::Isometry3d& T_world_camera);

 private:
  LogWriter& log_;
  FrameEncoder encoder_;
  FrameDecoder check_;
  RgbdFrame decoded_;
  std::int64_t truth_seq_ = 0;
};

}  // namespace roomwise
