#pragma once
#include <Eigen/Geometry>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/time.h"
#include "services/simulator/core/scene.h"
#include "services/simulator/device/frame_door.h"
#include "services/simulator/render/simulated_kinect.h"
#include "services/simulator/simulator_params.h"

namespace roomwise::simulator {

/// An instant at which the simulated camera takes a frame.
struct CameraMoment {
  Time stamp;
  Duration since_start{};  ///< where the world's walkers are, and the camera's own clock
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// The simulated camera at work: renders the newest moment on a thread of its own and puts the
/// frame into the frame door. A moment that comes before the last one was begun replaces it.
/// Nothing is rendered while nobody waits for frames.
class CameraFeed {
 public:
  /// `scene` must outlive it. Throws as FrameDoor and SimulatedKinect do.
  CameraFeed(const Scene& scene, const SimulatorParams& params, const std::filesystem::path& door);
  CameraFeed(const CameraFeed&) = delete;
  CameraFeed& operator=(const CameraFeed&) = delete;
  ~CameraFeed();

  /// Never waits for a frame.
  void take(const CameraMoment& moment);

  std::int64_t frames() const { return frames_; }
  /// Moments that were replaced.
  std::int64_t dropped() const { return dropped_; }

 private:
  /// So many moments after a reader was last seen waiting it is taken to be gone.
  static constexpr int kMomentsPatience = 30;

  bool is_watched();
  void work();
  std::optional<CameraMoment> next_moment();
  void render(const CameraMoment& moment);

  SimulatedKinect kinect_;
  FrameDoor door_;
  RgbdFrame frame_;
  std::uint64_t looks_ = 0;
  int moments_unwatched_ = kMomentsPatience;
  std::atomic<std::int64_t> frames_ = 0;
  std::atomic<std::int64_t> dropped_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<CameraMoment> newest_;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace roomwise::simulator
