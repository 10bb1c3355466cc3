#include "services/simulator/recording/recorded_drive.h"

#include <fmt/format.h>

#include <stdexcept>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "common/frames/frame_encoder.h"
#include "common/frames/label_encoder.h"
#include "services/simulator/core/kinect/true_labels.h"
#include "services/simulator/core/path_follower.h"
#include "services/simulator/recording/recording_host.h"
#include "services/simulator/render/simulated_kinect.h"
#include "services/simulator/simulator_messages.h"
#include "services/simulator/world_setup.h"

namespace roomwise::simulator {
namespace {

/// When recorded drives begin: 2026-01-01 00:00 UTC. A log's bytes depend on no clock.
constexpr Time kBeginning = time_from_utime(1'767'225'600'000'000);
constexpr double kWheelBase_m = 0.235;
constexpr int kJpegQuality = 85;

KinectMode mode_of(const SimulatorParams& params) {
  const bool large = params.camera_size == "640x480";
  return {.width_px = large ? 640 : 320,
          .height_px = large ? 480 : 240,
          .registered = params.camera_registered};
}

const Path& path_of(const Scene& scene, const std::string& name) {
  if (const Path* path = find_path(scene, name)) return *path;
  std::string names;
  for (const Path& path : scene.paths) names += " " + path.name;
  throw std::runtime_error(fmt::format("scenario {} has no path {}; it has:{}", scene.name, name,
                                       names.empty() ? " none" : names));
}

/// The camera of a recorded drive: every moment becomes a message.
class RecordedCamera {
 public:
  RecordedCamera(const SimulatorParams& params, const Scene& scene)
      : kinect_(scene, params.depth, params.color, static_cast<std::uint32_t>(params.seed)),
        mode_(mode_of(params)) {
    frame_.T_robot_camera = T_robot_camera(scene.camera);
  }

  const kinect_frame_t& capture(const SimulatedWorld& world, Time stamp) {
    const Duration now = world.now();
    kinect_.capture(world.T_world_camera(), seconds(now), message_.seq, mode_, frame_);
    message_.utime = utime_of(stamp);
    message_.device_time_us = now.count();
    ++message_.seq;
    message_.depth_registered = frame_.depth_registered ? 1 : 0;
    encoder_.encode_depth(frame_.depth, kinect_frame_t::DEPTH_PDZ16, message_);
    encoder_.encode_color(frame_.color, kinect_frame_t::COLOR_JPEG, kJpegQuality, message_);
    encode_depth_camera(frame_.depth_camera, message_);
    encode_color_camera(frame_.color_camera, message_);
    encode_pose(frame_.T_robot_camera, message_);
    return message_;
  }

  /// What a perfect segmentation of the last frame would say: its label image, nothing else.
  const segmentation_t& true_segments() {
    true_labels(kinect_.view(), frame_.depth.steps, labels_);
    true_segments_.utime = message_.utime;
    true_segments_.seq = true_segments_.frame_seq = message_.seq;
    label_encoder_.encode(labels_, frame_.depth.width_px, frame_.depth.height_px, true_segments_);
    return true_segments_;
  }

 private:
  SimulatedKinect kinect_;
  KinectMode mode_;
  FrameEncoder encoder_;
  RgbdFrame frame_;
  kinect_frame_t message_{};
  LabelEncoder label_encoder_;
  std::vector<std::uint8_t> labels_;
  segmentation_t true_segments_{};
};

class RecordedDrive {
 public:
  RecordedDrive(const SimulatorParams& params, const DriveOrder& request, LogWriter& log)
      : world_(world_of(params)),
        camera_(params, world_.scene()),
        follower_({world_.scene().start, path_of(world_.scene(), request.path)}, kWheelBase_m),
        log_(log),
        with_true_labels_(params.true_labels) {}

  DriveSummary run(Duration longest) {
    while (!follower_.done() && (longest == Duration{0} || world_.now() < longest)) {
      if (world_.now() % RecordingHost::kTurn == Duration{0}) talk();
      step();
    }
    return {.frames = frames_, .driven_s = seconds(world_.now()), .arrived = follower_.done()};
  }

 private:
  void talk() {
    LeftRight<double> wheels_mps;
    if (turn_ >= RecordingHost::kFirstDrivingTurn) {
      wheels_mps = follower_.step(world_.create().motion().pose(), seconds(RecordingHost::kTurn));
    }
    to_robot_.clear();
    host_.talk(turn_++, wheels_mps.left, wheels_mps.right, to_robot_);
    world_.create().receive(to_robot_);
  }

  void step() {
    from_robot_.clear();
    world_.step(from_robot_);
    const Duration now = world_.now();
    const Time stamp = kBeginning + now;
    host_.receive(stamp, from_robot_);
    for (const create_state_t& state : host_.states()) {
      log_.write(channels::kCreateState, stamp, state);
    }
    for (const odometry_t& odometry : host_.steps()) {
      log_.write(channels::kOdometry, stamp, odometry);
    }
    if (is_due(now, kTruthRate_hz)) write_truth(now, stamp);
    if (is_due(now, kCameraRate_hz)) {
      log_.write(channels::kKinectFrame, stamp, camera_.capture(world_, stamp));
      if (with_true_labels_) log_.write(channels::kTrueSegments, stamp, camera_.true_segments());
      ++frames_;
    }
  }

  void write_truth(Duration now, Time stamp) {
    truth_t truth = truth_message(world_, stamp, is_due(now, kLandmarkRate_hz));
    truth.seq = ++truth_seq_;
    log_.write(channels::kTruth, stamp, truth);
  }

  SimulatedWorld world_;
  RecordedCamera camera_;
  PathFollower follower_;
  RecordingHost host_;
  LogWriter& log_;
  bool with_true_labels_;
  int turn_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t truth_seq_ = 0;
  std::vector<std::uint8_t> to_robot_;
  std::vector<std::uint8_t> from_robot_;
};

}  // namespace

DriveSummary record_drive(const SimulatorParams& params, const DriveOrder& request,
                          const std::filesystem::path& log_path) {
  if (params.interface.model != "create2") {
    throw std::runtime_error("create_model must be create2: a recorded drive needs its encoders");
  }
  std::filesystem::path part = log_path;
  part += ".part";
  try {
    LogWriter log(part);
    RecordedDrive drive(params, request, log);
    const DriveSummary summary = drive.run(Duration{std::llround(request.seconds * 1e6)});
    log.close();
    std::filesystem::rename(part, log_path);
    return summary;
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace roomwise::simulator
