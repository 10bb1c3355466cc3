#include "logs/tools/import_oni.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "common/bus/log_file.h"
#include "logs/tools/camera_pose.h"
#include "logs/tools/oni_recording.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/progress.h"
#include "logs/tools/rgbd_log.h"
#include "logs/tools/whole_file.h"
#include "services/kinect_pub/core/depth_words.h"

namespace roomwise {
namespace {

constexpr double kDepthMax_m = 10.0;  // beyond it a Kinect says nothing

/// Times that increase, by a device's clock that may start anew.
class RecordingClock {
 public:
  std::int64_t utime(std::int64_t device_time_us) {
    const std::int64_t step_us = device_time_us - last_us_.value_or(device_time_us - kPeriod_us);
    const bool goes_on = step_us > 0 && step_us <= kLeap_us;
    utime_ += goes_on ? step_us : kPeriod_us;
    last_us_ = device_time_us;
    return utime_;
  }

 private:
  static constexpr std::int64_t kPeriod_us = 33'333;
  static constexpr std::int64_t kLeap_us = 3'600'000'000;
  std::int64_t utime_ = kUndated_utime - kPeriod_us;
  std::optional<std::int64_t> last_us_;
};

void drop_far_readings(DepthImage& depth) {
  const auto farthest = std::min<long>(std::lround(kDepthMax_m / depth.unit_m), 65534);
  kinect::drop_depths_above(static_cast<int>(farthest), depth.steps);
}

}  // namespace

void import_oni(const OniImport& import, std::ostream& notes) {
  OniRecording recording(import.recording);
  ReplacedFile file(import.out);
  LogWriter log(file.temporary());
  RgbdLog rgbd(log);
  Progress progress("import", static_cast<std::uint64_t>(recording.depth_images()));
  ImportedFrame frame;
  frame.T_robot_camera = level_mounting(import.camera_height_m);
  frame.depth_registered = import.registered && recording.has_color();
  // Registered depth is the depth that the colour camera would see.
  frame.camera = frame.depth_registered ? recording.color_camera() : recording.depth_camera();
  if (recording.has_color()) frame.color_camera = recording.color_camera();
  RecordingClock clock;
  OniFrame read;
  while (recording.next(read)) {
    ++frame.seq;
    frame.device_time_us = read.depth_time_us;
    frame.utime = clock.utime(read.depth_time_us);
    drop_far_readings(read.depth);
    std::swap(frame.depth, read.depth);
    frame.color = encode_jpeg(read.color);
    rgbd.write_frame(frame, import.recording);
    progress.show(static_cast<std::uint64_t>(frame.seq));
  }
  log.close();
  file.commit();
  fmt::print(
      notes,
      "frames {}, {}; depth images without colour left out: {}\nassumed: depth {} to colour; "
      "level camera {} m above the floor; times from a day of our own choice on\n",
      frame.seq, recording.has_color() ? "with colour" : "without colour",
      recording.without_color(), frame.depth_registered ? "registered" : "not registered",
      import.camera_height_m);
}

void add_import_oni(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("oni", "An OpenNI2 recording.");
  const auto import = std::make_shared<OniImport>();
  command.add_option("FILE", import->recording, "recording, .oni")->required();
  command.add_option("-o", import->out, "log to write")->required();
  command.add_option("--camera-height", import->camera_height_m, "above the floor [m]")
      ->capture_default_str()
      ->check(positive_number());
  command.add_flag("--registered", import->registered, "its depth is registered to its colour");
  command.callback([import] { import_oni(*import, std::cout); });
}

}  // namespace roomwise
