#pragma once
#include <filesystem>
#include <memory>

#include "common/image/rgbd_frame.h"
#include "services/kinect_pub/core/frame_pairing.h"

namespace roomwise {

/// A depth image of a recording, and the colour image of the same instant.
struct OniFrame {
  std::int64_t depth_time_us = 0;  ///< device clock
  DepthImage depth;
  ColorImage color;  ///< empty if there is none
};

/// An OpenNI2 recording, read image by image as fast as it can be. One at a time, by one thread.
class OniRecording {
 public:
  /// Throws std::runtime_error naming the file and why it cannot be played.
  explicit OniRecording(const std::filesystem::path& path);
  OniRecording(const OniRecording&) = delete;
  OniRecording& operator=(const OniRecording&) = delete;
  ~OniRecording();

  /// Fills `frame` with the next depth image, in the recording's order. False at the end. Throws
  /// std::runtime_error naming the file if an image cannot be read.
  bool next(OniFrame& frame);

  bool has_color() const;
  int depth_images() const;  ///< as the file says
  std::int64_t without_color() const { return without_color_; }
  const PinholeCamera& depth_camera() const { return depth_camera_; }
  const PinholeCamera& color_camera() const { return color_camera_; }

 private:
  struct Streams;
  [[noreturn]] void refuse(const std::string& what) const;

  std::filesystem::path path_;
  std::unique_ptr<Streams> streams_;
  PinholeCamera depth_camera_;
  PinholeCamera color_camera_;
  std::int64_t without_color_ = 0;
};

}  // namespace roomwise
