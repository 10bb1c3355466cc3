#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/simulator/device/frame_door_request.h"

namespace roomwise::simulator {

namespace door {
struct Layout;
}

/// One instant as it came through a frame door.
struct DoorFrame {
  std::int64_t number = 0;  ///< the writer's count, from 1
  std::int64_t device_time_us = 0;
  bool depth_registered = false;
  int depth_width_px = 0;
  int depth_height_px = 0;
  int color_width_px = 0;
  int color_height_px = 0;
  std::vector<std::uint16_t> depth_mm;  ///< row by row
  std::vector<std::uint8_t> rgb;        ///< row by row
};

/// The camera driver's end of a FrameDoor. Never harms the writer; whole frames only.
class FrameDoorReader {
 public:
  enum class Wait {
    kFrame,    ///< a frame that was not handed out before
    kNothing,  ///< none came in time
    kGone,     ///< the writer closed its door or died; it never comes back through this reader
  };

  /// Opens the door at `path`. Throws std::runtime_error with the path and what is wrong: nothing
  /// there, nobody alive behind it, or a file that is no frame door.
  explicit FrameDoorReader(const std::filesystem::path& path);
  FrameDoorReader(const FrameDoorReader&) = delete;
  FrameDoorReader& operator=(const FrameDoorReader&) = delete;
  ~FrameDoorReader();

  /// Tells the writer what frames to make.
  void ask(const FrameRequest& request);

  /// Waits for the next frame: the one after the last handed out, or the oldest still there if the
  /// writer has gone round since. Frames written before the reader was opened are not handed out.
  Wait next(DoorFrame& frame, std::chrono::milliseconds patience);

  /// True as long as the writer lives and has its door open.
  bool is_served() const;

  /// Frames the writer overwrote before they were handed out.
  std::int64_t missed() const { return missed_; }

  const std::string& serial() const { return serial_; }
  const PinholeCamera& depth_camera() const { return depth_camera_; }
  const PinholeCamera& color_camera() const { return color_camera_; }

 private:
  bool copy_next(DoorFrame& frame);
  bool copy(std::uint64_t number, DoorFrame& frame);
  void sleep_until_woken(std::uint32_t seen, std::chrono::milliseconds patience);

  int file_ = -1;
  door::Layout* layout_ = nullptr;
  std::uint64_t last_ = 0;
  std::int64_t missed_ = 0;
  std::string serial_;
  PinholeCamera depth_camera_;
  PinholeCamera color_camera_;
};

}  // namespace roomwise::simulator
