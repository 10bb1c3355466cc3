#include "services/ekf_svc/ekf_service.h"

#include <algorithm>
#include <stdexcept>

#include "services/ekf_svc/ekf_messages.h"

namespace roomwise {
namespace {

constexpr std::size_t kFramesWaitingMax = 64;  // two seconds of a camera
constexpr std::int64_t kMapPeriod_us = 1'000'000;
constexpr std::int64_t kKeepPeriod_us = 5'000'000;

constexpr const char* reason(ekf::OdometryVerdict verdict) {
  switch (verdict) {
    case ekf::OdometryVerdict::kUsed:
      return "odometry_used";
    case ekf::OdometryVerdict::kFirst:
      return "odometry_first";
    case ekf::OdometryVerdict::kGap:
      return "odometry_gap";
    case ekf::OdometryVerdict::kRestarted:
      return "odometry_clock_restarted";
    case ekf::OdometryVerdict::kTimeInvalid:
      return "odometry_time_invalid";
    case ekf::OdometryVerdict::kOutOfOrder:
      return "odometry_out_of_order";
    case ekf::OdometryVerdict::kNotFinite:
      return "odometry_not_finite";
    case ekf::OdometryVerdict::kTooFast:
      return "odometry_too_fast";
    case ekf::OdometryVerdict::kCovarianceInvalid:
      return "odometry_covariance_invalid";
  }
  return "odometry_unknown";
}

constexpr const char* reason(ekf::FrameTiming timing) {
  switch (timing) {
    case ekf::FrameTiming::kReady:
      return "frame_ready";
    case ekf::FrameTiming::kWaits:
      return "frame_waits";
    case ekf::FrameTiming::kNoOdometry:
      return "frame_before_odometry";
    case ekf::FrameTiming::kDuplicate:
      return "frame_duplicate";
    case ekf::FrameTiming::kLate:
      return "frame_late";
    case ekf::FrameTiming::kAheadOfBelief:
      return "frame_ahead_of_odometry";
  }
  return "frame_unknown";
}

}  // namespace

EkfService::EkfService(Bus& bus, const Params& params)
    : bus_(bus), params_(params), estimator_(params) {
  load_map();
  bus_.subscribe(channels::kOdometry, [this](const odometry_t& m) { on_odometry(m); });
  bus_.subscribe(channels::kLandmarks, [this](const landmark_list_t& m) { on_landmarks(m); });
}

void EkfService::on_odometry(const odometry_t& message) {
  const ekf::OdometryVerdict verdict = estimator_.add_odometry(to_sample(message));
  if (verdict != ekf::OdometryVerdict::kUsed) bus_.count(reason(verdict));
  if (!ekf::is_used(verdict)) return;
  use_waiting_frames();
  pose_t pose = to_pose_message(estimator_, last_frame_);
  bus_.publish(channels::kPose, pose);
  publish_map_if_due();
  keep_map_if_due();
}

void EkfService::on_landmarks(const landmark_list_t& message) {
  const Time taken = time_from_utime(message.utime);
  const ekf::FrameTiming timing = estimator_.timing(taken);
  if (timing != ekf::FrameTiming::kReady && timing != ekf::FrameTiming::kWaits) {
    return bus_.count(reason(timing));
  }
  if (waiting_.size() == kFramesWaitingMax) return bus_.count("frame_queue_full");
  WaitingFrame frame{taken, {}, ScanBeams(message)};
  frame.sightings.reserve(message.landmarks.size());
  std::transform(message.landmarks.begin(), message.landmarks.end(),
                 std::back_inserter(frame.sightings), to_sighting);
  const auto later =
      std::upper_bound(waiting_.begin(), waiting_.end(), frame.time,
                       [](Time time, const WaitingFrame& waiting) { return time < waiting.time; });
  waiting_.insert(later, std::move(frame));
  use_waiting_frames();
  publish_map_if_due();
}

void EkfService::use_waiting_frames() {
  while (!waiting_.empty()) {
    const ekf::FrameTiming timing = estimator_.timing(waiting_.front().time);
    if (timing == ekf::FrameTiming::kWaits) return;
    if (timing == ekf::FrameTiming::kReady) {
      use(waiting_.front());
    } else {
      bus_.count(reason(timing));
    }
    waiting_.pop_front();
  }
}

void EkfService::use(const WaitingFrame& frame) {
  verdicts_.resize(frame.sightings.size());
  last_frame_ = estimator_.process(frame.time, frame.sightings, verdicts_, frame.beams.scan());
  if (last_frame_.pose_widened) bus_.count("pose_widened");
  for (const ekf::Verdict verdict : verdicts_) {
    if (verdict != ekf::Verdict::kMatched) bus_.count(ekf::name_of(verdict));
  }
}

EkfService::~EkfService() { keep_map(); }

void EkfService::load_map() {
  if (params_.map_path.empty()) {
    if (params_.mode == "localise") throw std::runtime_error("mode localise needs map_path");
    return;
  }
  map_file_.emplace(params_.map_path);
  MapFile::Loaded loaded = map_file_->load();
  if (!loaded.complaint.empty()) {
    bus_.count("map_file_damaged");
    bus_.note_error(loaded.complaint);
  }
  if (!loaded.map.empty()) {
    estimator_.lose(std::move(loaded.map));
  } else if (params_.mode == "localise") {
    throw std::runtime_error("mode localise: no map in " + params_.map_path + " " +
                             loaded.complaint);
  }
}

void EkfService::keep_map_if_due() {
  const std::int64_t period = utime_of(estimator_.estimate().time) / kKeepPeriod_us;
  if (period == keep_period_number_) return;
  keep_period_number_ = period;
  keep_map();
}

/// A map that cannot be written must not stop the robot: it is said, and tried again.
void EkfService::keep_map() try {
  if (!map_file_ || params_.mode == "localise") return;
  estimator_.save(kept_);
  if (!kept_.empty()) map_file_->save(kept_);
} catch (const std::exception& error) {
  bus_.count("map_file_not_written");
  bus_.note_error(error.what());
}

void EkfService::publish_map_if_due() {
  if (estimator_.state() == ekf::Estimator::State::kLost) return;  // of where, nobody knows
  const std::int64_t second = utime_of(estimator_.estimate().time) / kMapPeriod_us;
  const std::size_t count = estimator_.filter().mapped_count();
  if (second == map_second_ && count == map_count_) return;
  map_second_ = second;
  map_count_ = count;
  landmark_map_t map = to_map_message(estimator_);
  bus_.publish(channels::kLandmarkMap, map);
}

}  // namespace roomwise
