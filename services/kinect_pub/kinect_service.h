#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "common/bus/bus.h"
#include "services/kinect_pub/core/kinect_params.h"
#include "services/kinect_pub/device/capture.h"
#include "services/kinect_pub/device/latest_slot.h"
#include "services/kinect_pub/device/openni_library.h"
#include "services/kinect_pub/frame_worker.h"

namespace roomwise {

/// A camera in, KINECT_FRAME and KINECT_STATUS out. Three threads: capture waits for images, a
/// worker encodes, the bus's own publishes. Between them lies one slot each, where the newest frame
/// displaces one that nobody took.
class KinectService {
 public:
  using Params = kinect::KinectParams;

  /// Throws std::runtime_error in a replay, where no camera is, or if a recording named by
  /// `params.device` cannot be opened. A camera that is not there is waited for.
  KinectService(Bus& bus, const Params& params);
  ~KinectService();

 private:
  void publish_frame();
  void publish_status(Time time);
  void say_changes(const CaptureReport& report);
  void report_second(Time time);
  void count_up_to(const std::string& counter, std::int64_t total);

  Bus& bus_;
  Params params_;
  OpenNiLibrary library_;
  LatestSlot<CapturedFrame> frames_;
  LatestSlot<kinect_frame_t> messages_;
  kinect_frame_t message_{};
  device_status_t status_{};
  std::string said_;
  std::int64_t frames_at_last_second_ = 0;
  std::map<std::string, std::int64_t> counted_;
  std::unique_ptr<FrameWorker> worker_;
  std::unique_ptr<Capture> capture_;
};

}  // namespace roomwise
