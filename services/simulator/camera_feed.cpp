#include "services/simulator/camera_feed.h"

#include <utility>

#include "services/simulator/render/kinect_renderer.h"

namespace roomwise::simulator {
namespace {

FrameDoorDescription description_of(const SimulatorParams& params) {
  return {.serial = "roomwise-sim",
          .depth_camera = kinect_camera(params.depth.depth_focal_px, 640, 480),
          .color_camera = kinect_camera(params.color.color_focal_px, 640, 480)};
}

/// Both images have the size asked for of depth: the renderer makes them together.
KinectMode mode_of(const FrameRequest& request) {
  return {.width_px = request.depth_width_px,
          .height_px = request.depth_width_px * 3 / 4,
          .registered = request.depth_registered};
}

}  // namespace

CameraFeed::CameraFeed(const Scene& scene, const SimulatorParams& params,
                       const std::filesystem::path& door)
    : kinect_(scene, params.depth, params.color, static_cast<std::uint32_t>(params.seed)),
      door_(door, description_of(params)),
      thread_([this] { work(); }) {}

CameraFeed::~CameraFeed() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

bool CameraFeed::is_watched() {
  const std::uint64_t looks = door_.looks();
  moments_unwatched_ = looks == looks_ ? moments_unwatched_ + 1 : 0;
  looks_ = looks;
  return moments_unwatched_ < kMomentsPatience;
}

void CameraFeed::take(const CameraMoment& moment) {
  if (!is_watched()) return;
  {
    const std::lock_guard lock(mutex_);
    if (newest_) ++dropped_;
    newest_ = moment;
  }
  changed_.notify_one();
}

std::optional<CameraMoment> CameraFeed::next_moment() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return newest_ || is_ending_; });
  return is_ending_ ? std::nullopt : std::exchange(newest_, std::nullopt);
}

void CameraFeed::work() {
  while (const auto moment = next_moment()) render(*moment);
}

void CameraFeed::render(const CameraMoment& moment) {
  kinect_.capture(moment.T_world_camera, seconds(moment.since_start), frames_,
                  mode_of(door_.request()), frame_);
  frame_.utime = utime_of(moment.stamp);
  door_.write(frame_, moment.since_start.count());
  ++frames_;
}

}  // namespace roomwise::simulator
