#include "services/ekf_svc/core/estimator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace roomwise::ekf {
namespace {

constexpr Duration kJumpMax = std::chrono::seconds(10);  // ahead, by one report alone
constexpr int kReportsToBelieveAClock = 5;               // in order among themselves
constexpr Duration kFrameAheadMax = std::chrono::seconds(1);
constexpr double kMissingMin_s = 0.005;  // less than this is jitter of time stamps
constexpr double kMissingMax_s = 10.0;
constexpr double kBridgeSpeedMax_mps = 5.0;

constexpr double kRelocaliseEvery_m = 0.25;  // of way
constexpr double kRelocalisedFor_m = 1.0;    // how long it is said
constexpr double kLostSigma = 1e3;           // of a pose nobody should use [m, rad]

bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad);
}

}  // namespace

Estimator::Estimator(const EkfParams& params) : params_(params), slam_(params), schedule_(params) {}

OdometryVerdict Estimator::add_odometry(const OdometrySample& sample) {
  const OdometryVerdict fault = check(sample);
  if (fault != OdometryVerdict::kUsed) return fault;
  if (!has_odometry_) return first(sample);
  const Duration since = sample.time - last_.time;
  if (since <= Duration(0) || since > kJumpMax) return out_of_order(sample);
  return follow(sample);
}

OdometryVerdict Estimator::first(const OdometrySample& sample) {
  timeline_.restart(sample.time);
  last_ = sample;
  has_odometry_ = true;
  return OdometryVerdict::kFirst;
}

/// One report from another time is refused; several that follow each other are a clock that was
/// set.
OdometryVerdict Estimator::out_of_order(const OdometrySample& sample) {
  const Duration since = sample.time - strange_.time;
  const bool follows = strange_count_ > 0 && since > Duration(0) && since <= kJumpMax;
  strange_count_ = follows ? strange_count_ + 1 : 1;
  strange_ = sample;
  if (strange_count_ < kReportsToBelieveAClock) return OdometryVerdict::kOutOfOrder;

  strange_count_ = 0;
  move_filter(timeline_.end());
  MotionIncrement unseen;
  const double heading_sigma = params_.gap_turn_sigma_radps * kMissingMax_s;
  const double position_sigma = params_.gap_distance_sigma_mps * kMissingMax_s;
  unseen.covariance.diagonal() << heading_sigma * heading_sigma, position_sigma * position_sigma,
      position_sigma * position_sigma;
  slam_.predict(unseen);
  timeline_.restart(sample.time);
  schedule_.restart();
  has_frame_ = false;
  last_ = sample;
  return OdometryVerdict::kRestarted;
}

OdometryVerdict Estimator::follow(const OdometrySample& sample) {
  const double missing_s = seconds(sample.time - last_.time - sample.interval);
  const bool is_gap = missing_s > std::max(kMissingMin_s, 0.5 * seconds(sample.interval));
  drop_latency();  // up to the last report: frames inside this one may be waiting
  timeline_.append(sample.time, step_of(sample, is_gap ? missing_s : 0.0));
  strange_count_ = 0;
  last_ = sample;
  return is_gap ? OdometryVerdict::kGap : OdometryVerdict::kUsed;
}

/// Hands the filter the motion no frame may ask for any more.
void Estimator::drop_latency() {
  const auto latency =
      std::chrono::duration_cast<Duration>(std::chrono::duration<double>(params_.latency_max_s));
  const Time oldest = timeline_.end() - latency;
  if (timeline_.start() < oldest) move_filter(oldest);
  if (timeline_.is_full()) move_filter(timeline_.first_end());
}

MotionStep Estimator::step_of(const OdometrySample& sample, double missing_s) const {
  const Eigen::Matrix2d covariance = params_.odometry_noise_ratio * sample.covariance;
  MotionStep step = sample.is_asked_for ? speed_step(sample.distance_m, sample.turn_rad, covariance)
                                        : arc_step(sample.distance_m, sample.turn_rad, covariance);
  if (missing_s <= 0.0) return step;
  if (bridges(sample)) {
    step = chord_step(compose(inverse(last_.T_odom_robot), sample.T_odom_robot), step.covariance);
  }
  const double heading_sigma = params_.gap_turn_sigma_radps * missing_s;
  const double position_sigma = params_.gap_distance_sigma_mps * missing_s;
  step.covariance.diagonal() +=
      Eigen::Vector3d(heading_sigma * heading_sigma, position_sigma * position_sigma,
                      position_sigma * position_sigma);
  return step;
}

/// The wheels kept counting while reports were lost: the odometry pose says where they led.
bool Estimator::bridges(const OdometrySample& sample) const {
  if (sample.reset_counter != last_.reset_counter) return false;
  if (!is_finite(sample.T_odom_robot) || !is_finite(last_.T_odom_robot)) return false;
  const double travel_m =
      (sample.T_odom_robot.position_m() - last_.T_odom_robot.position_m()).norm();
  return travel_m <= kBridgeSpeedMax_mps * seconds(sample.time - last_.time);
}

FrameTiming Estimator::timing(Time frame) const {
  if (!has_odometry_) return FrameTiming::kNoOdometry;
  if (has_frame_ && frame == last_frame_) return FrameTiming::kDuplicate;
  if (frame < timeline_.start()) return FrameTiming::kLate;
  if (frame <= timeline_.end()) return FrameTiming::kReady;
  return frame <= timeline_.end() + kFrameAheadMax ? FrameTiming::kWaits
                                                   : FrameTiming::kAheadOfBelief;
}

FrameResult Estimator::process(Time frame, std::span<const Sighting> sightings,
                               std::span<Verdict> verdicts, const VirtualScan& scan) {
  if (timing(frame) != FrameTiming::kReady) throw std::logic_error("Estimator: frame not ready");
  move_filter(frame);
  const bool is_due = schedule_.is_due(frame);
  const FrameResult result = slam_.process(sightings, is_due, verdicts, scan);
  if (result.matched > 0) schedule_.updated(frame);
  if (!relocaliser_ && slam_.says_lost()) lose_here();
  relocalise();
  has_frame_ = true;
  last_frame_ = frame;
  return result;
}

void Estimator::move_filter(Time until) {
  const MotionIncrement motion = timeline_.take(until, filter().calibration());
  schedule_.moved(motion, until);
  slam_.predict(motion);
}

PoseEstimate Estimator::estimate() const {
  const MotionIncrement ahead = timeline_.ahead(filter().calibration());
  const Pose2 pose = filter().pose();
  PoseEstimate estimate{
      timeline_.end(), moved(pose, ahead),
      moved_covariance(pose.heading_rad, filter().robot_covariance(), ahead).topLeftCorner<3, 3>()};
  if (relocaliser_) estimate.covariance.diagonal().setConstant(kLostSigma * kLostSigma);
  return estimate;
}

Estimator::State Estimator::state() const {
  if (!has_odometry_) return State::kStarting;
  if (relocaliser_ || slam_.is_doubtful()) return State::kLost;
  return slam_.travel_m() < relocalised_until_travel_m_ ? State::kRelocalised : State::kTracking;
}

void Estimator::lose(MapSnapshot map) {
  relocaliser_.emplace(std::move(map));
  slam_.begin_anew();
  relocalise_due_travel_m_ = slam_.travel_m() + kRelocaliseEvery_m;
}

/// What was mapped so far becomes the map to be found again in.
void Estimator::lose_here() {
  MapSnapshot map;
  filter().save(map);
  lose(std::move(map));
}

void Estimator::relocalise() {
  if (!relocaliser_ || slam_.travel_m() < relocalise_due_travel_m_) return;
  relocalise_due_travel_m_ = slam_.travel_m() + kRelocaliseEvery_m;
  filter().save(local_);
  const auto place = relocaliser_->find(local_);
  if (!place || !slam_.resume(relocaliser_->map(), local_, *place)) return;
  relocaliser_.reset();
  relocalised_until_travel_m_ = slam_.travel_m() + kRelocalisedFor_m;
}

void Estimator::save(MapSnapshot& map) const {
  map = {};
  if (!relocaliser_) filter().save(map);
}

}  // namespace roomwise::ekf
