#include <fmt/core.h>

#include <stdexcept>

#include "logs/tools/log_replay.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/point_files.h"
#include "logs/tools/recording.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

struct PointsOptions {
  std::filesystem::path log;
  std::filesystem::path out;
  std::optional<std::int64_t> frame;
  std::string poses = "POSE";
  double voxel_m = 0.02;
  double range_max_m = 5.0;
};

struct NamedCloud {
  PointCloud cloud;
  std::string comment;  ///< which frame it stands in
};

Eigen::Isometry3d in_space(const Pose2& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() << pose.x_m, pose.y_m, 0.0;
  return T;
}

/// Adds frames to a grid, each where its pose says.
class CloudBuilder {
 public:
  explicit CloudBuilder(const PointsOptions& options)
      : options_(options), decoder_(ColorUse::kDecode), grid_(options.voxel_m) {}

  void add(const kinect_frame_t& message, const Pose2& T_map_robot) {
    if (decoder_.decode(message, frame_) != FrameResult::kOk) return;
    grid_.add(points_of(frame_, options_.range_max_m),
              in_space(T_map_robot) * frame_.T_robot_camera);
    ++frames_;
  }

  std::int64_t frames() const { return frames_; }
  PointCloud cloud() const { return grid_.thinned(); }

 private:
  const PointsOptions& options_;
  FrameDecoder decoder_;
  RgbdFrame frame_;
  VoxelGrid grid_;
  std::int64_t frames_ = 0;
};

NamedCloud cloud_of_frame(const PointsOptions& options) {
  CloudBuilder builder(options);
  const LogReading reading = replay_log(options.log, [&](Bus& bus) {
    bus.subscribe(channels::kKinectFrame, [&](const kinect_frame_t& message) {
      if (message.seq - 1 == *options.frame) builder.add(message, Pose2{});
    });
  });
  if (builder.frames() == 0) {
    reading.raise_complaints(options.log);
    throw std::runtime_error(
        fmt::format("{}: holds no whole frame {}", options.log.string(), *options.frame));
  }
  return {builder.cloud(), fmt::format("frame {}, robot frame [m]", *options.frame)};
}

Trajectory trajectory_from(const PointsOptions& options) {
  Recording recording;
  static_cast<void>(replay_log(options.log, [&](Bus& bus) { gather(bus, recording); }));
  sort_by_time(recording);
  if (options.poses == channels::kOdometry.name) return recording.odometry;
  return options.poses == channels::kTruth.name ? recording.truth : recording.poses;
}

NamedCloud cloud_of_log(const PointsOptions& options) {
  const Trajectory trajectory = trajectory_from(options);
  CloudBuilder builder(options);
  const LogReading reading = replay_log(options.log, [&](Bus& bus) {
    bus.subscribe(channels::kKinectFrame, [&](const kinect_frame_t& message) {
      if (const auto pose = pose_at(trajectory, message.utime)) builder.add(message, *pose);
    });
  });
  reading.raise_complaints(options.log);
  if (builder.frames() == 0) {
    throw std::runtime_error(fmt::format("{}: holds no frame with a pose on {} (--poses, --frame)",
                                         options.log.string(), options.poses));
  }
  return {builder.cloud(),
          fmt::format("{} frames placed by {} [m]", builder.frames(), options.poses)};
}

using Format = std::string (*)(const PointCloud&, const std::string&);

void run_export_points(const PointsOptions& options, Format format) {
  const NamedCloud made = options.frame ? cloud_of_frame(options) : cloud_of_log(options);
  write_whole_file(options.out, format(made.cloud, made.comment));
  fmt::print("{} points of {}\n", made.cloud.size(), made.comment);
}

void add_points(CLI::App& parent, const char* name, const char* what, Format format) {
  CLI::App& command = *parent.add_subcommand(name, what);
  const auto options = std::make_shared<PointsOptions>();
  command.add_option("LOG", options->log, "a log with KINECT_FRAME")->required();
  command.add_option("-o", options->out, "file to write")->required();
  command
      .add_option("--frame", options->frame, "KINECT_FRAME.seq - 1; else all, placed by --poses")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--poses", options->poses, "where the frames were taken")
      ->capture_default_str()
      ->check(CLI::IsMember({"POSE", "ODOMETRY", "TRUTH"}));
  command.add_option("--voxel", options->voxel_m, "one point a cube of this side [m]")
      ->capture_default_str()
      ->check(CLI::Range(VoxelGrid::kSmallestVoxel_m, 10.0));
  command.add_option("--range-max", options->range_max_m, "depth beyond is left out [m]")
      ->capture_default_str()
      ->check(positive_number());
  command.callback([options, format] { run_export_points(*options, format); });
}

}  // namespace

void add_export_ply(CLI::App& parent) {
  add_points(parent, "ply", "Coloured points of a frame or of a whole log, as PLY.", as_ply);
}

void add_export_pcd(CLI::App& parent) {
  add_points(parent, "pcd", "Coloured points of a frame or of a whole log, as PCD.", as_pcd);
}

}  // namespace roomwise
