#include "logs/tools/import_7scenes.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "logs/tools/camera_pose.h"
#include "logs/tools/frame_files.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/progress.h"
#include "logs/tools/rgbd_log.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/text_table.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

constexpr std::int64_t kRate_hz = 30;
constexpr double kDepthUnit_m = 0.001;
constexpr std::uint16_t kNoReading = 65535;
constexpr PinholeCamera kPublishedCamera{585.0, 585.0, 320.0, 240.0};

/// All numbers of a small text file, which must be `count`.
std::vector<double> read_numbers(const std::filesystem::path& path, std::size_t count) {
  TextTable table(path);
  std::vector<double> numbers;
  while (table.next(1)) {
    for (std::size_t i = 0; i < table.size(); ++i) numbers.push_back(table.number(i, "an element"));
  }
  if (numbers.size() != count) {
    table.refuse(fmt::format("file has {} numbers, needs {}", numbers.size(), count));
  }
  return numbers;
}

/// A 4 x 4 rigid transform, row by row.
Eigen::Isometry3d read_pose(const std::filesystem::path& path) {
  constexpr double kRotationTolerance = 1e-2;
  const std::vector<double> rows = read_numbers(path, 16);
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data());
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  if (!(R * R.transpose()).isIdentity(kRotationTolerance) || R.determinant() < 0.0) {
    throw std::runtime_error(fmt::format("{}: not a rotation", path.string()));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

PinholeCamera read_camera(const std::filesystem::path& folder, std::ostream& notes) {
  const auto path = folder / "camera-intrinsics.txt";
  if (!std::filesystem::exists(path)) {
    fmt::print(notes, "assumed: no camera-intrinsics.txt: fx = fy = 585 px, centre 320, 240\n");
    return kPublishedCamera;
  }
  const std::vector<double> k = read_numbers(path, 9);
  if (k[0] <= 0.0 || k[4] <= 0.0) {
    throw std::runtime_error(fmt::format("{}: focal lengths must be positive", path.string()));
  }
  return {.fx_px = k[0], .fy_px = k[4], .cx_px = k[2], .cy_px = k[5]};
}

/// The file beside frame-N.depth.png with another ending.
std::filesystem::path sibling(const std::filesystem::path& depth_path, std::string_view ending) {
  const std::string name = depth_path.filename().string();
  return depth_path.parent_path() / (name.substr(0, name.find('.')) + std::string(ending));
}

std::map<int, Eigen::Isometry3d> read_poses(
    const std::map<int, std::filesystem::path>& depth_paths) {
  std::map<int, Eigen::Isometry3d> poses;
  for (const auto& [number, depth_path] : depth_paths) {
    const auto path = sibling(depth_path, ".pose.txt");
    if (std::filesystem::exists(path)) poses.emplace(number, read_pose(path));
  }
  return poses;
}

/// T_floor_world: from the set's world to ours, on the floor below the first camera.
Eigen::Isometry3d floor_frame(const Eigen::Vector3d& down_world, const Eigen::Isometry3d& first,
                              double camera_height_m) {
  Eigen::Isometry3d T_floor_world = Eigen::Isometry3d::Identity();
  T_floor_world.linear() = level_rotation(down_world);
  const Pose2 robot = robot_below(T_floor_world * first);
  const double z_m = (T_floor_world * first).translation().z();
  T_floor_world.pretranslate(Eigen::Vector3d(-robot.x_m, -robot.y_m, camera_height_m - z_m));
  T_floor_world.prerotate(Eigen::AngleAxisd(-robot.heading_rad, Eigen::Vector3d::UnitZ()));
  return T_floor_world;
}

/// Where the camera is in our world and on the robot, frame by frame.
class Mounting {
 public:
  Mounting(const SevenScenesImport& import, std::map<int, Eigen::Isometry3d> poses,
           std::ostream& notes)
      : T_world_camera_(std::move(poses)), level_(level_mounting(import.camera_height_m)) {
    const auto path = import.folder / "gravity-direction.txt";
    has_gravity_ = std::filesystem::exists(path);
    fmt::print(notes, "assumed: first camera {} m above the floor\n", import.camera_height_m);
    if (T_world_camera_.empty()) {
      fmt::print(notes, "assumed: no pose files: level camera, no TRUTH\n");
      return;
    }
    const Eigen::Isometry3d first = T_world_camera_.begin()->second;
    Eigen::Vector3d down_world = first.linear().col(1);
    if (has_gravity_) {
      down_world = Eigen::Vector3d(read_numbers(path, 3).data());
      if (down_world.norm() < 0.1) {
        throw std::runtime_error(fmt::format("{}: not a direction", path.string()));
      }
      fmt::print(notes, "gravity from {}: tilt of every camera pose\n", path.filename().string());
    } else {
      fmt::print(notes, "assumed: no gravity-direction.txt: level camera\n");
    }
    const Eigen::Isometry3d T_floor_world = floor_frame(down_world, first, import.camera_height_m);
    for (auto& [number, pose] : T_world_camera_) pose = T_floor_world * pose;
  }

  const Eigen::Isometry3d* T_world_camera(int number) const {
    const auto pose = T_world_camera_.find(number);
    return pose == T_world_camera_.end() ? nullptr : &pose->second;
  }

  Eigen::Isometry3d T_robot_camera(int number) const {
    const Eigen::Isometry3d* pose = T_world_camera(number);
    return has_gravity_ && pose != nullptr ? mounting_of(*pose) : level_;
  }

 private:
  std::map<int, Eigen::Isometry3d> T_world_camera_;
  Eigen::Isometry3d level_;
  bool has_gravity_ = false;
};

ImportedFrame read_frame(int number, const std::filesystem::path& depth_path) {
  ImportedFrame frame;
  frame.seq = number + 1;
  frame.device_time_us = std::int64_t{number} * 1000000 / kRate_hz;
  frame.utime = kUndated_utime + frame.device_time_us;
  frame.depth = read_depth_png(depth_path, kDepthUnit_m);
  std::ranges::replace(frame.depth.steps, kNoReading, std::uint16_t{0});
  const auto png = sibling(depth_path, ".color.png");
  const auto jpg = sibling(depth_path, ".color.jpg");
  frame.color = read_color_as_jpeg(std::filesystem::exists(png) ? png : jpg);
  return frame;
}

}  // namespace

void import_7scenes(const SevenScenesImport& import, std::ostream& notes) {
  const auto depth_paths = find_frame_files(import.folder, ".depth.png");
  fmt::print(notes, "frames {}\nassumed: {} Hz from 2013-01-01 00:00 UTC, for there are no times\n",
             depth_paths.size(), kRate_hz);
  fmt::print(notes, "assumed: depth not registered to colour (near edges lie some 20 px apart)\n");
  const PinholeCamera camera = read_camera(import.folder, notes);
  const Mounting mounting(import, read_poses(depth_paths), notes);

  ReplacedFile file(import.out);
  LogWriter log(file.temporary());
  RgbdLog rgbd(log);
  Progress progress("import", depth_paths.size());
  std::uint64_t done = 0;
  for (const auto& [number, depth_path] : depth_paths) {
    ImportedFrame frame = read_frame(number, depth_path);
    frame.camera = camera;
    frame.T_robot_camera = mounting.T_robot_camera(number);
    rgbd.write_frame(frame, depth_path);
    if (const auto* pose = mounting.T_world_camera(number)) rgbd.write_truth(frame.utime, *pose);
    progress.show(++done);
  }
  log.close();
  file.commit();
}

void add_import_7scenes(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("7scenes", "A 7-Scenes folder: frames, camera poses.");
  const auto import = std::make_shared<SevenScenesImport>();
  command.add_option("DIR", import->folder, "folder of frame-N.depth.png")->required();
  command.add_option("-o", import->out, "log to write")->required();
  command
      .add_option("--camera-height", import->camera_height_m, "first camera above the floor [m]")
      ->capture_default_str()
      ->check(positive_number());
  command.callback([import] { import_7scenes(*import, std::cout); });
}

}  // namespace roomwise
