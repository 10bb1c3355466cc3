#include "logs/tools/import_oni.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <iostream>
#include <memory>

#include "common/bus/log_file.h"
#include "logs/tools/camera_pose.h"
#include "logs/tools/oni_recording.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/progress.h"
#include "logs/tools/rgbd_log.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

constexpr std::int64_t kFirstDay_utime = 1356998400000000;  // 2013-01-01 00:00 UTC

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
  OniFrame read;
  while (recording.next(read)) {
    ++frame.seq;
    frame.device_time_us = read.depth_time_us;
    frame.utime = kFirstDay_utime + read.depth_time_us;
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
