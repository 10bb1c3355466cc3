#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "common/time.h"
#include "services/kinect_pub/core/clock_mapping.h"
#include "services/kinect_pub/core/reopen_backoff.h"
#include "services/kinect_pub/device/latest_slot.h"
#include "services/kinect_pub/device/openni_camera.h"

namespace roomwise {

/// How capture fares at one moment.
struct CaptureReport {
  enum class State { kSearching, kStreaming, kLost, kEnded };
  State state = State::kSearching;
  CameraFacts facts;  ///< of the device in use, or of the last one
  std::int64_t frames_dropped = 0;
  std::int64_t depth_unpaired = 0;
  std::int64_t color_unpaired = 0;
  std::int64_t malformed = 0;
  std::int64_t losses = 0;
  std::int64_t reconnects = 0;
  std::int64_t clock_restarts = 0;
  std::int64_t clock_offset_us = 0;
  std::string error;  ///< empty while all is well
};

/// A thread that keeps a camera streaming for ever: opens it, puts each pair into a slot, and when
/// the device goes silent or away opens it anew, waiting a little longer each time.
class Capture {
 public:
  struct Settings {
    CameraRequest camera;
    kinect::ClockMapping::Params clock;
    Duration silence_max{1'000'000};  ///< without a pair for so long the device is lost
    Duration start_max{5'000'000};    ///< the same before its first pair
  };

  /// `now` and `changed` are called from capture's own thread: the first for the time a frame
  /// arrived, the second when report() has a new state or error.
  Capture(OpenNiLibrary& library, const Settings& settings, LatestSlot<CapturedFrame>& frames,
          std::function<Time()> now, std::function<void()> changed);
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  ~Capture();

  CaptureReport report() const;

 private:
  using State = CaptureReport::State;

  void run();
  void use_camera();
  void stream_from(OpenNiCamera& camera);
  void hand_over(CapturedFrame& frame);
  void count_loss();
  void account(const OpenNiCamera& camera);
  void close_account(const OpenNiCamera& camera);
  void set_state(State state, const std::string& error);

  OpenNiLibrary& library_;
  const Settings settings_;
  LatestSlot<CapturedFrame>& frames_;
  const std::function<Time()> now_;
  const std::function<void()> changed_;
  kinect::ClockMapping clock_;
  kinect::ReopenBackoff backoff_;

  mutable std::mutex mutex_;
  CaptureReport report_;
  CaptureReport before_;  ///< sums over devices closed
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace roomwise
