#pragma once
#include "common/bus/bus.h"
#include "common/frames/frame_decoder.h"
#include "services/landmark_svc/core/landmark_detector.h"
#include "services/landmark_svc/odometry_track.h"

namespace roomwise {

/// KINECT_FRAME and ODOMETRY in, one LANDMARKS out for each frame that can be decoded; the others
/// are counted by reason ("frame_bad_depth"). Live, only the newest frame is worked on. What is
/// published depends on the frames and the odometry received before them alone.
class LandmarkService {
 public:
  using Params = landmark::LandmarkParams;
  LandmarkService(Bus& bus, const Params& params);

 private:
  void on_odometry(const odometry_t& message);
  void on_frame(const kinect_frame_t& message);

  Bus& bus_;
  FrameDecoder decoder_;
  OdometryTrack odometry_;
  landmark::LandmarkDetector detector_;
  RgbdFrame frame_;
  landmark_list_t landmarks_{};
};

}  // namespace roomwise
