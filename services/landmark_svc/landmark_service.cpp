#include "services/landmark_svc/landmark_service.h"

#include <stdexcept>

#include "services/landmark_svc/landmark_messages.h"

namespace roomwise {

LandmarkService::LandmarkService(Bus& bus, const Params& params)
    : bus_(bus),
      decoder_(params.use_color ? ColorUse::kDecode : ColorUse::kSkip),
      detector_(params) {
  bus_.subscribe(channels::kOdometry, [this](const odometry_t& message) { on_odometry(message); });
  bus_.subscribe(
      channels::kKinectFrame, [this](const kinect_frame_t& message) { on_frame(message); },
      Delivery::kLatest);
}

void LandmarkService::on_odometry(const odometry_t& message) {
  switch (odometry_.take(message)) {
    case OdometryTrack::Result::kOk:
      return;
    case OdometryTrack::Result::kNotUsable:
      bus_.count("odometry_not_usable");
      return;
    case OdometryTrack::Result::kStartedAnew:
      bus_.count("odometry_started_anew");
      detector_.forget_motion();
  }
}

void LandmarkService::on_frame(const kinect_frame_t& message) {
  const FrameResult decoded = decoder_.decode(message, frame_);
  if (decoded != FrameResult::kOk) {
    bus_.count(counter_name(decoded));
    return;
  }
  if (detector_.detect(frame_, odometry_.at(frame_.utime)) != landmark::DetectResult::kOk) {
    throw std::logic_error("the landmark detector refused a frame the frame decoder had passed");
  }
  fill_message(detector_, frame_, landmarks_);
  bus_.publish(channels::kLandmarks, landmarks_);
}

}  // namespace roomwise
