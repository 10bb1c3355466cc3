#include "services/ekf_svc/core/slam_filter.h"

#include <algorithm>
#include <array>
#include <functional>

#include "services/ekf_svc/core/planar_group.h"
#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {
namespace {

Landmark united(const Landmark& old, const Landmark& recent) {
  constexpr std::int32_t kCountMax = 1'000'000'000;
  Landmark both = old;
  both.times_seen = std::min(old.times_seen, kCountMax) + std::min(recent.times_seen, kCountMax);
  both.signature = fused(old.signature, recent.signature);
  both.last_seen_travel_m = std::max(old.last_seen_travel_m, recent.last_seen_travel_m);
  both.refusals = 0;
  return both;
}

}  // namespace

SlamFilter::SlamFilter(ErrorForm form, std::size_t landmark_budget)
    : form_(form),
      budget_(landmark_budget),
      covariance_(landmark_index(landmark_budget)),
      x_(covariance_.stride()),
      gains_(kDimensionMax * covariance_.stride()),
      scratch_(4 * covariance_.stride()) {
  landmarks_.reserve(landmark_budget);
  equalities_.reserve(kResidualsMax);
  leaving_.reserve(kResidualsMax);
  for (std::size_t i = 0; i < kPoseSize; ++i) covariance_.set(i, i, kStartVariance);
}

void SlamFilter::predict(const MotionIncrement& motion) {
  const RobotMatrix moved_robot =
      moved_covariance(heading(), robot_covariance(), motion);  // before x_ changes
  const RobotMatrix F = transition(heading(), motion);
  const Eigen::Matrix<double, 3, 4> D = F.block<3, 4>(0, kCalibration);
  const Eigen::Vector2d shift = rotation2(heading()) * motion.translation_m;

  std::array<double*, kRangeCalibration> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = covariance_.row(i);
  for (std::size_t j = kRobotSize; j < size(); ++j) {
    Eigen::Vector3d with_pose(rows[0][j], rows[1][j], rows[2][j]);
    const Eigen::Vector4d with_calibration(rows[3][j], rows[4][j], rows[5][j], rows[6][j]);
    with_pose.tail<2>() += F.block<2, 1>(1, 0) * with_pose(0);
    with_pose += D * with_calibration;
    for (std::size_t i = 0; i < kPoseSize; ++i) {
      rows[i][j] = with_pose(static_cast<Eigen::Index>(i));
    }
  }
  for (std::size_t i = 0; i < kRobotSize; ++i) {
    for (std::size_t j = i; j < kRobotSize; ++j) {
      const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
      covariance_.set(i, j, 0.5 * (moved_robot(r, c) + moved_robot(c, r)));
    }
  }
  double* x = x_.data();
  x[kHeading] = wrap_angle(x[kHeading] + motion.turn_rad);
  x[kPosition] += shift.x();
  x[kPosition + 1] += shift.y();
}

void SlamFilter::free_calibration(const Eigen::Vector3d& sigma, double turn_loss_sigma_m_per_rad) {
  drift_calibration(sigma.cwiseProduct(sigma));
  covariance_.set(
      kTurnLoss, kTurnLoss,
      covariance_.at(kTurnLoss, kTurnLoss) + turn_loss_sigma_m_per_rad * turn_loss_sigma_m_per_rad);
}

void SlamFilter::free_range_calibration(double sigma) {
  for (const std::size_t i : {kRangeCalibration, kRangeCalibration + 1}) {
    covariance_.set(i, i, covariance_.at(i, i) + sigma * sigma);
  }
}

void SlamFilter::drift_calibration(const Eigen::Vector3d& variance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = kCalibration + k;
    covariance_.set(i, i, covariance_.at(i, i) + variance(static_cast<Eigen::Index>(k)));
  }
}

void SlamFilter::widen_pose(double position_sigma_m, double heading_sigma_rad) {
  MotionIncrement unseen;
  unseen.covariance.diagonal() << heading_sigma_rad * heading_sigma_rad,
      position_sigma_m * position_sigma_m, position_sigma_m * position_sigma_m;
  predict(unseen);
}

bool SlamFilter::add(const BodyObservation& seen, const Landmark& landmark) {
  if (landmarks_.size() == budget_) return false;
  const std::size_t n = size();
  const Eigen::Matrix2d rotation = rotation2(heading());
  const Eigen::Vector2d offset = rotation * seen.p_robot_m;
  const Eigen::Vector2d lever = quarter_turn(offset);

  const double* with_heading = covariance_.row(kHeading);
  const double* with_x = covariance_.row(kPosition);
  const double* with_y = covariance_.row(kPosition + 1);
  const double* with_tilt = covariance_.row(kRangeCalibration);
  const double* with_curvature = covariance_.row(kRangeCalibration + 1);
  const Eigen::Matrix2d per_calibration = -rotation * seen.per_calibration;
  // Rows of the robot first: the others need only them.
  Eigen::Matrix<double, 2, kRobotSize> G = Eigen::Matrix<double, 2, kRobotSize>::Zero();
  G.leftCols<3>() << lever.x(), 1.0, 0.0, lever.y(), 0.0, 1.0;
  G.rightCols<2>() = per_calibration;
  const Eigen::Matrix<double, 2, kRobotSize> with_robot = G.lazyProduct(robot_covariance());
  for (std::size_t j = kRobotSize; j < n; ++j) {
    const Eigen::Vector2d with_ranges =
        per_calibration * Eigen::Vector2d(with_tilt[j], with_curvature[j]);
    covariance_.row(j)[n] = lever.x() * with_heading[j] + with_x[j] + with_ranges.x();
    covariance_.row(j)[n + 1] = lever.y() * with_heading[j] + with_y[j] + with_ranges.y();
  }
  for (std::size_t j = 0; j < kRobotSize; ++j) {
    covariance_.row(j)[n] = with_robot(0, static_cast<Eigen::Index>(j));
    covariance_.row(j)[n + 1] = with_robot(1, static_cast<Eigen::Index>(j));
  }
  const Eigen::Matrix2d own =
      with_robot * G.transpose() + rotation * seen.covariance_m2 * rotation.transpose();
  covariance_.set(n, n, own(0, 0));
  covariance_.set(n, n + 1, 0.5 * (own(0, 1) + own(1, 0)));
  covariance_.set(n + 1, n + 1, own(1, 1));

  x_.data()[n] = x_.data()[kPosition] + offset.x();
  x_.data()[n + 1] = x_.data()[kPosition + 1] + offset.y();
  landmarks_.push_back(landmark);
  landmarks_.back().map_id = landmark.is_tentative ? 0 : next_map_id_++;
  return true;
}

void SlamFilter::remove(std::size_t l) {
  const std::size_t last = landmarks_.size() - 1;
  const std::size_t to = landmark_index(l);
  const std::size_t from = landmark_index(last);
  if (l != last) {
    for (std::size_t r = 0; r < 2; ++r) {
      for (std::size_t j = 0; j < from; ++j) {
        if (j == to || j == to + 1) continue;
        covariance_.set(to + r, j, covariance_.at(from + r, j));
      }
      for (std::size_t s = r; s < 2; ++s) {
        covariance_.set(to + r, to + s, covariance_.at(from + r, from + s));
      }
      x_.data()[to + r] = x_.data()[from + r];
    }
    landmarks_[l] = landmarks_[last];
  }
  landmarks_.pop_back();
}

UpdateResult SlamFilter::merge(std::span<const LandmarkPair> pairs, double sigma_m) {
  equalities_.clear();
  leaving_.clear();
  for (const LandmarkPair& pair : pairs) {
    equalities_.push_back(equality_residual(pair.recent, pair.old, sigma_m));
  }
  const UpdateResult result = update(equalities_);
  if (result != UpdateResult::kUsed) return result;
  for (const LandmarkPair& pair : pairs) {
    landmarks_[pair.old] = united(landmarks_[pair.old], landmarks_[pair.recent]);
    leaving_.push_back(pair.recent);
  }
  // The highest number first: what takes its place is never itself about to leave.
  std::sort(leaving_.begin(), leaving_.end(), std::greater<>());
  for (const std::size_t l : leaving_) remove(l);
  return result;
}

Pose2 SlamFilter::pose() const {
  return {x_.data()[kPosition], x_.data()[kPosition + 1], heading()};
}

Eigen::Matrix3d SlamFilter::pose_covariance() const {
  return robot_covariance().topLeftCorner<3, 3>();
}

OdometryCalibration SlamFilter::calibration() const {
  const double* value = x_.data() + kCalibration;
  return {{value[0], value[1], value[2]}, value[3]};
}

RangeCalibration SlamFilter::range_calibration() const { return {point(kRangeCalibration)}; }

RobotMatrix SlamFilter::robot_covariance() const {
  RobotMatrix P;
  for (std::size_t i = 0; i < kRobotSize; ++i) {
    for (std::size_t j = 0; j < kRobotSize; ++j) {
      P(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = covariance_.at(i, j);
    }
  }
  return P;
}

}  // namespace roomwise::ekf
