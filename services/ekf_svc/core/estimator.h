#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/geometry/pose2.h"
#include "common/time.h"
#include "services/ekf_svc/core/ekf_params.h"
#include "services/ekf_svc/core/odometry_sample.h"
#include "services/ekf_svc/core/odometry_timeline.h"
#include "services/ekf_svc/core/relocaliser.h"
#include "services/ekf_svc/core/slam.h"
#include "services/ekf_svc/core/update_schedule.h"

namespace roomwise::ekf {

/// Whether a frame taken at some time can be used now.
enum class FrameTiming {
  kReady,
  kWaits,          ///< odometry has not come so far yet
  kNoOdometry,     ///< nothing is known of the motion
  kDuplicate,      ///< taken at the same instant as the last one used
  kLate,           ///< older than the last one used, or than latency_max_s before the odometry
  kAheadOfBelief,  ///< far later than the odometry: another clock
};

/// Where the robot is at the newest odometry.
struct PoseEstimate {
  Time time{};
  Pose2 T_map_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (heading, x, y)
};

/// EKF-SLAM in time: keeps odometry until a frame needs it, moves the filter exactly to the instant
/// each frame was taken, and composes the filter's pose with the odometry since.
///
/// Frames must be offered in order of their time; what the same calls give does not depend on when
/// they are made.
class Estimator {
 public:
  explicit Estimator(const EkfParams& params);

  OdometryVerdict add_odometry(const OdometrySample& sample);

  FrameTiming timing(Time frame) const;

  /// Uses a frame whose timing is kReady (else std::logic_error). `verdicts` is as long as
  /// `sightings` and says what became of each.
  FrameResult process(Time frame, std::span<const Sighting> sightings, std::span<Verdict> verdicts,
                      const VirtualScan& scan = {});

  /// Where the pose stands.
  enum class State { kStarting, kTracking, kLost, kRelocalised };
  State state() const;

  /// Makes the robot lost in this map: what it maps from now on is its own, until it is found where
  /// in the map it is.
  void lose(MapSnapshot map);

  /// The map as it should be kept; empty while the robot is lost.
  void save(MapSnapshot& map) const;

  PoseEstimate estimate() const;
  const SlamFilter& filter() const { return slam_.filter(); }
  double noise_ratio() const { return slam_.noise_ratio(); }

 private:
  OdometryVerdict first(const OdometrySample& sample);
  OdometryVerdict out_of_order(const OdometrySample& sample);
  OdometryVerdict follow(const OdometrySample& sample);
  MotionStep step_of(const OdometrySample& sample, double missing_s) const;
  bool bridges(const OdometrySample& sample) const;
  void drop_latency();
  void move_filter(Time until);

  void lose_here();
  void relocalise();

  EkfParams params_;
  Slam slam_;
  std::optional<Relocaliser> relocaliser_;  // while lost
  MapSnapshot local_;                       // what it is offered
  double relocalise_due_travel_m_ = 0.0;
  double relocalised_until_travel_m_ = -1.0;
  OdometryTimeline timeline_;
  UpdateSchedule schedule_;
  bool has_odometry_ = false;
  bool has_frame_ = false;
  Time last_frame_{};
  OdometrySample last_;     // the last report used
  OdometrySample strange_;  // the last one out of order
  int strange_count_ = 0;   // of them, one after another
};

}  // namespace roomwise::ekf
