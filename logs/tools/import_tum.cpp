#include "logs/tools/import_tum.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <array>
#include <iostream>
#include <stdexcept>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "logs/tools/association.h"
#include "logs/tools/camera_pose.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/progress.h"
#include "logs/tools/rgbd_log.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/text_table.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

constexpr std::int64_t kTolerance_us = 20000;

/// Times and what belongs to each; times ascend.
template <class Value>
struct Timed {
  std::vector<std::int64_t> utimes;
  std::vector<Value> values;

  void add(const TextTable& table, std::int64_t utime, Value value) {
    if (!utimes.empty() && utime < utimes.back()) table.refuse("time goes back");
    utimes.push_back(utime);
    values.push_back(std::move(value));
  }
};

using TimedFiles = Timed<std::string>;
using TimedPoses = Timed<Eigen::Isometry3d>;

TimedFiles read_files(const std::filesystem::path& path) {
  TextTable table(path);
  TimedFiles files;
  while (table.next(2)) files.add(table, table.utime(0, "time"), table.text(1));
  return files;
}

Eigen::Isometry3d pose_in(const TextTable& table) {
  const auto number = [&table](std::size_t field) { return table.number(field, "pose element"); };
  const Eigen::Quaterniond q(number(7), number(4), number(5), number(6));
  if (std::abs(q.norm() - 1.0) > 0.01) table.refuse("quaternion must be of unit length");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() << number(1), number(2), number(3);
  return pose;
}

TimedPoses read_truth(const std::filesystem::path& path, std::ostream& notes) {
  TimedPoses poses;
  if (!std::filesystem::exists(path)) {
    fmt::print(notes, "no groundtruth.txt: no TRUTH\n");
    return poses;
  }
  TextTable table(path);
  while (table.next(8)) poses.add(table, table.utime(0, "time"), pose_in(table));
  fmt::print(notes, "truth {} poses; assumed: its z points up from the floor\n",
             poses.utimes.size());
  return poses;
}

struct NamedCamera {
  std::string_view name;
  PinholeCamera camera;
};
// "Intrinsic camera calibration of the Kinect", the benchmark's page on file formats.
constexpr std::array kPublishedCameras = {
    NamedCamera{"freiburg1", {517.3, 516.5, 318.6, 255.3}},
    NamedCamera{"freiburg2", {520.9, 521.0, 325.1, 249.7}},
    NamedCamera{"freiburg3", {535.4, 539.2, 320.1, 247.6}},
};
constexpr NamedCamera kDefaultCamera{"ROS default", {525.0, 525.0, 319.5, 239.5}};

PinholeCamera choose_camera(const TumImport& import, std::ostream& notes) {
  if (import.camera) return *import.camera;
  const std::string folder = std::filesystem::weakly_canonical(import.folder).filename().string();
  NamedCamera chosen = kDefaultCamera;
  for (const NamedCamera& known : kPublishedCameras) {
    if (folder.find(known.name) != std::string::npos) chosen = known;
  }
  const PinholeCamera& camera = chosen.camera;
  fmt::print(notes, "assumed: intrinsics of {}: fx {}, fy {}, cx {}, cy {} px\n", chosen.name,
             camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px);
  return camera;
}

/// Indices into `depths` and `colors`.
std::vector<TimeMatch> pair_images(const std::filesystem::path& folder, const TimedFiles& depths,
                                   const TimedFiles& colors, std::ostream& notes) {
  auto matches = associate_by_time(depths.utimes, colors.utimes, kTolerance_us);
  if (matches.empty()) {
    throw std::runtime_error(
        fmt::format("{}: no depth image within 20 ms of a colour image", folder.string()));
  }
  fmt::print(
      notes, "frames {}; left out: {} depth and {} colour images without a partner in 20 ms\n",
      matches.size(), depths.utimes.size() - matches.size(), colors.utimes.size() - matches.size());
  return matches;
}

/// How the camera is held at `utime`, if truth knows of that time.
std::optional<Eigen::Isometry3d> mounting_at(const TimedPoses& truth, std::int64_t utime) {
  const auto match = associate_by_time(std::array{utime}, truth.utimes, kTolerance_us);
  if (match.empty()) return std::nullopt;
  return mounting_of(truth.values[match.front().second]);
}

/// Writes TRUTH up to a given time, message by message.
class TruthWriter {
 public:
  TruthWriter(RgbdLog& log, const TimedPoses& truth) : log_(log), truth_(truth) {}

  void write_before(std::int64_t utime) {
    for (; next_ < truth_.utimes.size() && truth_.utimes[next_] < utime; ++next_) {
      log_.write_truth(truth_.utimes[next_], truth_.values[next_]);
    }
  }

 private:
  RgbdLog& log_;
  const TimedPoses& truth_;
  std::size_t next_ = 0;
};

}  // namespace

void import_tum(const TumImport& import, std::ostream& notes) {
  const TimedFiles colors = read_files(import.folder / "rgb.txt");
  const TimedFiles depths = read_files(import.folder / "depth.txt");
  const auto matches = pair_images(import.folder, depths, colors, notes);
  const PinholeCamera camera = choose_camera(import, notes);
  const TimedPoses truth = read_truth(import.folder / "groundtruth.txt", notes);
  if (truth.utimes.empty()) {
    fmt::print(notes, "assumed: level camera {} m above the floor\n", import.camera_height_m);
  }

  ReplacedFile file(import.out);
  LogWriter log(file.temporary());
  RgbdLog rgbd(log);
  TruthWriter truth_writer(rgbd, truth);
  Progress progress("import", matches.size());
  ImportedFrame frame;
  frame.camera = camera;
  frame.T_robot_camera = level_mounting(import.camera_height_m);
  for (const TimeMatch& match : matches) {
    ++frame.seq;
    frame.utime = depths.utimes[match.first];
    frame.device_time_us = frame.utime;
    const auto depth_path = import.folder / depths.values[match.first];
    frame.depth = read_depth_png(depth_path, 1.0 / import.depth_scale);
    frame.depth_registered = true;
    frame.color = read_color_as_jpeg(import.folder / colors.values[match.second]);
    if (const auto mounting = mounting_at(truth, frame.utime)) frame.T_robot_camera = *mounting;
    truth_writer.write_before(frame.utime);
    rgbd.write_frame(frame, depth_path);
    progress.show(static_cast<std::uint64_t>(frame.seq));
  }
  truth_writer.write_before(std::numeric_limits<std::int64_t>::max());
  log.close();
  file.commit();
}

namespace {

/// What the command line gives as text.
struct TumOptions {
  TumImport import;
  std::vector<double> intrinsics;
};

void run_import_tum(TumOptions options) {
  if (const auto& k = options.intrinsics; !k.empty()) {
    options.import.camera = PinholeCamera{k[0], k[1], k[2], k[3]};
  }
  import_tum(options.import, std::cout);
}

}  // namespace

void add_import_tum(CLI::App& parent) {
  CLI::App& command =
      *parent.add_subcommand("tum", "A TUM RGB-D folder: rgb.txt, depth.txt, groundtruth.txt.");
  const auto options = std::make_shared<TumOptions>();
  TumImport& import = options->import;
  command.add_option("DIR", import.folder, "folder of rgb.txt and depth.txt")->required();
  command.add_option("-o", import.out, "log to write")->required();
  command.add_option("--intrinsics", options->intrinsics, "fx,fy,cx,cy [px]")
      ->delimiter(',')
      ->expected(4)
      ->check(positive_number());
  command.add_option("--depth-scale", import.depth_scale, "depth steps a metre")
      ->capture_default_str()
      ->check(positive_number());
  command.add_option("--camera-height", import.camera_height_m, "where there is no truth [m]")
      ->capture_default_str()
      ->check(positive_number());
  command.callback([options] { run_import_tum(*options); });
}

}  // namespace roomwise
