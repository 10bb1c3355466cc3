#include "logs/tools/import_fakenect.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <stdexcept>
#include <vector>

#include "common/bus/log_file.h"
#include "logs/tools/association.h"
#include "logs/tools/camera_pose.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/progress.h"
#include "logs/tools/rgbd_log.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/whole_file.h"
#include "services/kinect_pub/core/shift_depth.h"

namespace roomwise {
namespace {

constexpr int kDumpWidth_px = 640;
constexpr int kDumpHeight_px = 480;
constexpr std::int64_t kColorTolerance_us = 20000;
constexpr double kTicks_per_us = 60.0;
/// 120 cm to the reference plane, whose pixels of 640 columns are 0.2084 cm wide.
constexpr PinholeCamera kNominalCamera{575.8, 575.8, 319.5, 239.5};

struct DumpFile {
  std::string name;
  std::int64_t ticks = 0;  ///< 32 bits of them: they wrap after 71 s
};

/// By host time [us].
using DumpFiles = std::map<std::int64_t, DumpFile>;

struct Dump {
  DumpFiles depths;
  DumpFiles colors;
};

Dump read_index(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "INDEX.txt";
  std::ifstream index(path);
  if (!index) throw std::runtime_error(path.string() + ": cannot read");
  static const std::regex kName(R"(([dr])-(\d{1,12})\.(\d{6})-(\d{1,10})\.p[gp]m)");
  Dump dump;
  std::string line;
  while (std::getline(index, line)) {
    std::smatch part;
    if (!std::regex_match(line, part, kName)) continue;  // the accelerometer's, or audio
    const std::int64_t utime = std::stoll(part[2]) * 1'000'000 + std::stoll(part[3]);
    (part[1] == "d" ? dump.depths : dump.colors)[utime] = {line, std::stoll(part[4])};
  }
  if (dump.depths.empty()) throw std::runtime_error(path.string() + ": names no depth image");
  return dump;
}

DepthImage read_depth(const std::filesystem::path& path, const kinect::ShiftTable& table) {
  const std::vector<std::uint8_t> bytes = read_whole_file(path);
  constexpr std::string_view kHeader = "P5 640 480 65535\n";
  DepthImage depth{
      .width_px = kDumpWidth_px, .height_px = kDumpHeight_px, .unit_m = 0.001, .steps = {}};
  depth.steps.resize(static_cast<std::size_t>(kDumpWidth_px) * kDumpHeight_px);
  const std::size_t wanted = kHeader.size() + 2 * depth.size();
  if (bytes.size() != wanted || std::memcmp(bytes.data(), kHeader.data(), kHeader.size()) != 0) {
    throw std::runtime_error(path.string() + ": not a depth image of 640x480");
  }
  std::memcpy(depth.steps.data(), bytes.data() + kHeader.size(), 2 * depth.size());
  kinect::shifts_to_depths(table, depth.steps);
  return depth;
}

/// Microseconds by the camera's clock, which starts anew from 0 after 2^32 ticks.
class DeviceClock {
 public:
  std::int64_t time_us(std::int64_t ticks) {
    if (ticks < last_) turns_ += std::int64_t{1} << 32;
    last_ = ticks;
    return std::llround(static_cast<double>(turns_ + ticks) / kTicks_per_us);
  }

 private:
  std::int64_t last_ = 0;
  std::int64_t turns_ = 0;
};

std::vector<std::int64_t> times_of(const DumpFiles& files) {
  std::vector<std::int64_t> times;
  for (const auto& [utime, file] : files) times.push_back(utime);
  return times;
}

/// Name of the colour image of each depth image that has one, by the depth image's time.
std::map<std::int64_t, std::string> pair_colors(const Dump& dump) {
  const auto depth_times = times_of(dump.depths);
  const auto color_times = times_of(dump.colors);
  std::map<std::int64_t, std::string> colors;
  for (const auto& match : associate_by_time(depth_times, color_times, kColorTolerance_us)) {
    colors[depth_times[match.first]] = dump.colors.at(color_times[match.second]).name;
  }
  return colors;
}

}  // namespace

void import_fakenect(const FakenectImport& import, std::ostream& notes) {
  const Dump dump = read_index(import.folder);
  const auto colors = pair_colors(dump);
  const kinect::ShiftTable table = kinect::shift_table({});
  fmt::print(notes,
             "frames {}, with colour {}\nassumed: nominal Kinect v1, not registered; level camera "
             "{} m above the floor\n",
             dump.depths.size(), colors.size(), import.camera_height_m);

  ReplacedFile file(import.out);
  LogWriter log(file.temporary());
  RgbdLog rgbd(log);
  Progress progress("import", dump.depths.size());
  DeviceClock clock;
  ImportedFrame frame;
  frame.camera = kNominalCamera;
  frame.T_robot_camera = level_mounting(import.camera_height_m);
  for (const auto& [utime, depth] : dump.depths) {
    ++frame.seq;
    frame.utime = utime;
    frame.device_time_us = clock.time_us(depth.ticks);
    frame.depth = read_depth(import.folder / depth.name, table);
    const auto color = colors.find(utime);
    frame.color =
        color == colors.end() ? JpegImage{} : read_color_as_jpeg(import.folder / color->second);
    rgbd.write_frame(frame, import.folder / depth.name);
    progress.show(static_cast<std::uint64_t>(frame.seq));
  }
  log.close();
  file.commit();
}

void add_import_fakenect(CLI::App& parent) {
  CLI::App& command =
      *parent.add_subcommand("fakenect", "A Kinect v1 as libfreenect's fakenect-record wrote it.");
  const auto import = std::make_shared<FakenectImport>();
  command.add_option("DIR", import->folder, "folder of INDEX.txt")->required();
  command.add_option("-o", import->out, "log to write")->required();
  command.add_option("--camera-height", import->camera_height_m, "above the floor [m]")
      ->capture_default_str()
      ->check(positive_number());
  command.callback([import] { import_fakenect(*import, std::cout); });
}

}  // namespace roomwise
