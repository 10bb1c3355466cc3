#pragma once
#include <OpenNI.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "services/kinect_pub/core/frame_pairing.h"
#include "services/kinect_pub/device/captured_frame.h"
#include "services/kinect_pub/device/openni_library.h"

namespace roomwise {

/// What is asked of a camera.
struct CameraRequest {
  std::string uri;  ///< empty: any device
  int width_px = 640;
  int height_px = 480;
  bool use_color = true;
  bool register_depth = true;
  std::int64_t pair_tolerance_us = 17'000;
  bool loop_recording = false;
  bool recording_is_registered = false;
};

/// What a camera says of itself once its streams run.
struct CameraFacts {
  std::string name;
  std::string uri;
  std::string serial;
  int depth_width_px = 0;
  int depth_height_px = 0;
  int color_width_px = 0;
  int color_height_px = 0;
  bool depth_registered = false;
  bool mirrored_by_device = false;
  bool is_recording = false;
  PinholeCamera depth_camera;
  PinholeCamera color_camera;
};

/// A device and its streams. Streams go before their device.
struct OpenedStreams {
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoStream color;

  void close();
};

/// One opened OpenNI2 device with its depth and colour streams running. Used by one thread.
class OpenNiCamera {
 public:
  enum class Read {
    kPair,     ///< a frame is there
    kNothing,  ///< no whole pair yet
    kLost,     ///< OpenNI2 says the device went away
    kEnded,    ///< the recording is over
  };

  /// Opens and starts the device. Throws std::runtime_error naming the device and what it refused.
  OpenNiCamera(OpenNiLibrary& library, const CameraRequest& request);
  OpenNiCamera(const OpenNiCamera&) = delete;
  OpenNiCamera& operator=(const OpenNiCamera&) = delete;
  ~OpenNiCamera();

  /// Waits up to `patience` for the next image of either stream, and fills `frame` (but for its
  /// utime) if that completes a pair.
  Read read(std::chrono::milliseconds patience, CapturedFrame& frame);

  const CameraFacts& facts() const { return facts_; }
  std::int64_t depth_unpaired() const { return pairing_.depth_unpaired(); }
  std::int64_t color_unpaired() const { return pairing_.color_unpaired(); }
  std::int64_t malformed() const { return malformed_; }

 private:
  using Image = openni::VideoFrameRef;
  using Pairing = kinect::FramePairing<Image, Image>;

  [[noreturn]] void refuse(const std::string& what) const;
  void open_device();
  void open_stream(openni::VideoStream& stream, openni::SensorType sensor, const char* name);
  void choose_mode(openni::VideoStream& stream, openni::SensorType sensor, const char* name);
  void set_registration();
  void start(openni::VideoStream& stream, const char* name);
  void describe();
  std::optional<Pairing::Pair> take_image(int stream_index);
  bool fill(const Pairing::Pair& pair, CapturedFrame& frame);

  OpenNiLibrary& library_;
  CameraRequest request_;
  std::unique_ptr<OpenedStreams> streams_ = std::make_unique<OpenedStreams>();
  openni::Device& device_ = streams_->device;
  openni::VideoStream& depth_ = streams_->depth;
  openni::VideoStream& color_ = streams_->color;
  CameraFacts facts_;
  Pairing pairing_;
  bool depth_mirrored_ = false;
  bool color_mirrored_ = false;
  std::int64_t malformed_ = 0;
  std::int64_t losses_before_ = 0;
};

}  // namespace roomwise
