#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "common/image/rgbd_frame.h"
#include "services/simulator/device/frame_door_request.h"

namespace roomwise::simulator {

/// Where the frame door is unless somebody says otherwise: $ROOMWISE_SIM_KINECT, else
/// /dev/shm/roomwise-UID/kinect. The OpenNI2 driver looks there for a camera to list.
std::filesystem::path default_frame_door();

/// What a simulated camera says of itself. Cameras are those of the 640 x 480 images; OpenNI2 hands
/// on only their fields of view and takes the principal point to be (320, 240).
struct FrameDoorDescription {
  std::string serial;  ///< up to 31 characters
  PinholeCamera depth_camera{.fx_px = 575.8, .fy_px = 575.8, .cx_px = 320.0, .cy_px = 240.0};
  PinholeCamera color_camera{.fx_px = 525.0, .fy_px = 525.0, .cx_px = 320.0, .cy_px = 240.0};
};

/// The simulator's end of the camera cable: whole frames into shared memory, at a path, for any
/// number of readers (FrameDoorReader). As long as it lives the camera is plugged in; when it goes,
/// or its process is killed, every reader sees the camera unplugged. Writing never waits.
class FrameDoor {
 public:
  /// Makes the folder if need be. Throws std::runtime_error naming the path if that fails or
  /// another living process has a door there; one left behind by a killed process is replaced.
  FrameDoor(const std::filesystem::path& path, const FrameDoorDescription& description);
  FrameDoor(const FrameDoor&) = delete;
  FrameDoor& operator=(const FrameDoor&) = delete;
  ~FrameDoor();

  /// Hands on depth (steps of 1 mm) and colour of one instant, taken at `device_time_us` on the
  /// camera's own clock. Throws std::invalid_argument unless both images are 640 x 480 or
  /// 320 x 240. Readers ignore frames that are not of the size and registration asked for.
  void write(const RgbdFrame& frame, std::int64_t device_time_us);

  /// What the reader asked for last; what it asks of a new camera by default if nobody has.
  FrameRequest request() const;

  /// Grows as long as anybody waits for frames: several times a second.
  std::uint64_t looks() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  void* memory_ = nullptr;
  std::int64_t frames_ = 0;
};

}  // namespace roomwise::simulator
