#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/ekf_svc/core/body_observation.h"
#include "services/ekf_svc/core/covariance_store.h"
#include "services/ekf_svc/core/covariance_sweep.h"
#include "services/ekf_svc/core/landmark.h"
#include "services/ekf_svc/core/landmark_pair.h"
#include "services/ekf_svc/core/map_snapshot.h"
#include "services/ekf_svc/core/motion.h"
#include "services/ekf_svc/core/range_calibration.h"
#include "services/ekf_svc/core/residual.h"

namespace roomwise::ekf {

enum class ErrorForm {
  kPlain,      ///< the textbook EKF: correction added, covariance P - K S K^T
  kInvariant,  ///< the right-invariant EKF, in the coordinates of the plain one
};

enum class [[nodiscard]] UpdateResult{
    kUsed,
    kSingular,   ///< innovation covariance not positive definite; state untouched
    kNotFinite,  ///< a NaN or infinity would get in; state untouched
};

/// Normalised innovation squared of an update and how many numbers went into it.
struct InnovationStatistics {
  double squared = 0.0;
  int degrees_of_freedom = 0;
};

/// The mathematics of EKF-SLAM in the plane: state, covariance and what may be done to them. Which
/// measurement belongs to which landmark is decided elsewhere.
///
/// State for L landmarks, n = 9 + 2 L, in the map frame (the pose at construction):
///   x  n      [heading | x y | OdometryCalibration | RangeCalibration | l0x l0y | l1x l1y | ...]
///   P  n x n  covariance of the additive error, same order
///
/// The invariant form keeps P of additive errors d, in which prediction costs O(n), and is
/// nevertheless exactly the right-invariant EKF, whose error is e = d - u d_heading with
/// u = (0, J p, 0, J l0, ...): its update in d is
///   d = K innovation,  a = d_heading,
///   heading += a,  q = R(a) q + V(a) (d_q - J q a)      for robot and landmarks q,
///   P = P - K S K^T + g c^T + c g^T + c_heading g g^T,
///   g_q = J (q after - q before),  c = heading column of P - K S K^T.
/// So the directions no landmark measurement can observe (turning and shifting the whole world)
/// stay unobserved whatever the linearisation points, and no false heading information comes in.
///
/// Sources: Zhang, Wu, Song, Huang, Dissanayake, "Convergence and Consistency Analysis for a 3-D
/// Invariant-EKF SLAM", RA-L 2017; Barrau, Bonnabel, "An EKF-SLAM algorithm with consistency
/// properties", arXiv:1510.06263.
///
/// Takes its memory at construction. The same calls give the same bits.
class SlamFilter {
 public:
  SlamFilter(ErrorForm form, std::size_t landmark_budget);

  /// Moves the robot. O(n).
  void predict(const MotionIncrement& motion);

  /// Lets the odometry's calibration be estimated, from these sigmas on. At construction they are
  /// 0: odometry is taken at its word.
  void free_calibration(const Eigen::Vector3d& sigma, double turn_loss_sigma_m_per_rad = 0.0);
  /// Lets the ranges' calibration be estimated, either number from this sigma on. At construction
  /// it is 0: ranges are taken at their word.
  void free_range_calibration(double sigma);
  /// Adds variance to the odometry's calibration: tyres wear, floors change. O(1).
  void drift_calibration(const Eigen::Vector3d& variance);

  /// From now on updates move the robot alone, and know how uncertain the map is (Schmidt's
  /// consider filter).
  void fix_map(bool is_fixed) { map_is_fixed_ = is_fixed; }

  /// Adds variance to the pose alone: something moved the robot that odometry did not see. O(n).
  void widen_pose(double position_sigma_m, double heading_sigma_rad);

  /// Landmark `l` seen from the robot: z = R^T (f - p) + per_calibration c + noise, c the error of
  /// the range calibration `seen` was corrected by: the present one.
  Residual observation_residual(std::size_t l, const BodyObservation& seen) const;

  /// Landmarks `i` and `j` are one: 0 = R^T (f_i - f_j) + noise of `sigma_m` an axis. Written in
  /// the robot frame, and with its heading column, so that it observes no more than a measurement
  /// can.
  Residual equality_residual(std::size_t i, std::size_t j, double sigma_m) const;

  /// S = H P H^T + noise of one residual. Shape 2 x 2. O(1).
  Eigen::Matrix2d innovation_covariance(const Residual& residual) const;

  /// H_a P H_b^T of two residuals, without their noise. Shape 2 x 2. O(1).
  Eigen::Matrix2d cross_covariance(const Residual& a, const Residual& b) const;

  /// Corrects the state by all residuals at once (at most kResidualsMax), linearised at the present
  /// state. One sweep over the upper half of P. Throws std::logic_error on too many.
  UpdateResult update(std::span<const Residual> residuals);
  static constexpr std::size_t kResidualsMax = 32;

  /// Appends a landmark at the place it is seen, correlated with everything: f = p + R z,
  /// P_f. = G P_robot., P_ff = G P_robot G^T + R covariance R^T,
  /// G = [J (f - p), I, 0, -R per_calibration]. O(n).
  /// False, and nothing done, if the budget is used up. An observation that adds must not also
  /// update. The filter sets map_id, unless it is tentative.
  [[nodiscard]] bool add(const BodyObservation& seen, const Landmark& landmark);

  /// Tentative landmark `l` is sure, and gets a map_id.
  void enter_in_map(std::size_t l);

  /// Forgets landmark `l` (marginalises it); the last landmark takes its number. O(n).
  void remove(std::size_t l);

  /// Makes the recent landmark of each pair part of the old one, all in one update. On success the
  /// old ones hold what was known of both, and the recent ones are removed: landmark numbers
  /// change. No landmark may be in two pairs.
  UpdateResult merge(std::span<const LandmarkPair> pairs, double sigma_m);

  Pose2 pose() const;
  /// Covariance of (heading, x, y). Shape 3 x 3 [rad^2, rad m, m^2].
  Eigen::Matrix3d pose_covariance() const;
  OdometryCalibration calibration() const;
  RangeCalibration range_calibration() const;
  /// Covariance of (heading, x, y, OdometryCalibration, RangeCalibration). Shape 9 x 9.
  RobotMatrix robot_covariance() const;

  std::size_t landmark_count() const { return landmarks_.size(); }
  /// Of them, those in the map: not tentative.
  std::size_t mapped_count() const;
  std::size_t landmark_budget() const { return budget_; }
  const Landmark& landmark(std::size_t l) const { return landmarks_[l]; }
  Landmark& landmark(std::size_t l) { return landmarks_[l]; }
  Eigen::Vector2d landmark_position_m(std::size_t l) const { return point(landmark_index(l)); }
  Eigen::Matrix2d landmark_covariance_m2(std::size_t l) const {
    return covariance_.block2(landmark_index(l), landmark_index(l));
  }

  /// Of the last update that was used.
  const InnovationStatistics& last_innovation() const { return last_innovation_; }

  /// n and single elements, for tests and diagnosis.
  std::size_t size() const { return landmark_index(landmarks_.size()); }
  double state(std::size_t i) const { return x_.data()[i]; }
  double covariance(std::size_t i, std::size_t j) const { return covariance_.at(i, j); }

  static constexpr std::size_t kHeading = 0;
  static constexpr std::size_t kPosition = 1;
  static constexpr std::size_t kCalibration = 3;
  static constexpr std::size_t kPoseSize = 3;
  static constexpr std::size_t kTurnLoss = 6;  // of the odometry's calibration
  static constexpr std::size_t kRangeCalibration = 7;
  static constexpr std::size_t kRobotSize = 9;
  static constexpr std::size_t landmark_index(std::size_t l) { return kRobotSize + 2 * l; }

  /// The map without the robot and what is tentative. May allocate.
  void save(MapSnapshot& map) const;

  /// Goes on with a saved map, from a pose that owes nothing to it. What was known of
  /// odometry and ranges stays. False, and nothing done, if the budget is smaller.
  [[nodiscard]] bool restore(const MapSnapshot& map, const Pose2& pose,
                             const Eigen::Matrix3d& pose_covariance);

  /// As constructed; but no map_id is used twice.
  void reset();

 private:
  // The map starts at the pose, so it is exact; a trace of variance keeps P positive definite.
  static constexpr double kStartVariance = 1e-12;
  static constexpr std::size_t kDimensionMax = 2 * kResidualsMax;
  using InnovationMatrix = double[kDimensionMax][kDimensionMax];

  double heading() const { return x_.data()[kHeading]; }
  Eigen::Vector2d point(std::size_t i) const { return {x_.data()[i], x_.data()[i + 1]}; }
  double* gain(std::size_t k) { return gains_.data() + k * covariance_.stride(); }
  double* scratch(std::size_t k) { return scratch_.data() + k * covariance_.stride(); }

  void gather_gain(const Residual& residual, double* first, double* second);
  void fill_innovation_covariance(std::span<const Residual> residuals, InnovationMatrix& S);
  void whiten(std::size_t dimension, const InnovationMatrix& L, double* innovation);
  void correct(std::size_t dimension, const double* whitened);
  void retract(const double* correction);
  void retract_point(std::size_t i, const Eigen::Matrix2d& V, const double* correction);
  void sweep(std::size_t dimension);
  void correct_robot(std::size_t dimension, const double* correction);

  ErrorForm form_;
  std::size_t budget_;
  bool map_is_fixed_ = false;
  std::vector<Landmark> landmarks_;
  std::vector<Residual> equalities_;  // of one merge
  std::vector<std::size_t> leaving_;  // landmarks it removes
  std::int64_t next_map_id_ = 1;
  InnovationStatistics last_innovation_;

  CovarianceStore covariance_;
  AlignedBuffer x_;        // state
  AlignedBuffer gains_;    // kDimensionMax vectors: P H^T, then W = P H^T L^-T
  AlignedBuffer scratch_;  // 4 vectors: correction, g, d, heading column
};

}  // namespace roomwise::ekf
