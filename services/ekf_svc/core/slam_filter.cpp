#include "services/ekf_svc/core/slam_filter.h"

#include "services/ekf_svc/core/planar_group.h"

namespace roomwise::ekf {
namespace {

// The map starts at the pose, so it is exact; a trace of variance keeps P positive definite.
constexpr double kStartVariance = 1e-12;

}  // namespace

SlamFilter::SlamFilter(ErrorForm form, std::size_t landmark_budget)
    : form_(form),
      budget_(landmark_budget),
      covariance_(landmark_index(landmark_budget)),
      x_(covariance_.stride()),
      gains_(kDimensionMax * covariance_.stride()),
      scratch_(4 * covariance_.stride()) {
  landmarks_.reserve(landmark_budget);
  for (std::size_t i = 0; i < kPoseSize; ++i) covariance_.set(i, i, kStartVariance);
}

void SlamFilter::predict(const MotionIncrement& motion) {
  const Eigen::Matrix3d moved_pose =
      moved_covariance(heading(), pose_covariance(), motion);  // before x_ changes
  const Eigen::Vector2d shift = rotation2(heading()) * motion.translation_m;
  const Eigen::Vector2d lever = quarter_turn(shift);

  const double* with_heading = covariance_.row(kHeading);
  double* with_x = covariance_.row(kPosition);
  double* with_y = covariance_.row(kPosition + 1);
  for (std::size_t j = kPoseSize; j < size(); ++j) {
    with_x[j] += lever.x() * with_heading[j];
    with_y[j] += lever.y() * with_heading[j];
  }
  for (std::size_t i = 0; i < kPoseSize; ++i) {
    for (std::size_t j = i; j < kPoseSize; ++j) {
      const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
      covariance_.set(i, j, 0.5 * (moved_pose(r, c) + moved_pose(c, r)));
    }
  }
  double* x = x_.data();
  x[kHeading] = wrap_angle(x[kHeading] + motion.turn_rad);
  x[kPosition] += shift.x();
  x[kPosition + 1] += shift.y();
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
  // Rows of the pose first: the others need only them.
  Eigen::Matrix<double, 2, 3> G;
  G << lever.x(), 1.0, 0.0, lever.y(), 0.0, 1.0;
  const Eigen::Matrix<double, 2, 3> with_pose = G * pose_covariance();
  for (std::size_t j = kPoseSize; j < n; ++j) {
    covariance_.row(j)[n] = lever.x() * with_heading[j] + with_x[j];
    covariance_.row(j)[n + 1] = lever.y() * with_heading[j] + with_y[j];
  }
  for (std::size_t j = 0; j < kPoseSize; ++j) {
    covariance_.row(j)[n] = with_pose(0, static_cast<Eigen::Index>(j));
    covariance_.row(j)[n + 1] = with_pose(1, static_cast<Eigen::Index>(j));
  }
  const Eigen::Matrix2d own =
      with_pose * G.transpose() + rotation * seen.covariance_m2 * rotation.transpose();
  covariance_.set(n, n, own(0, 0));
  covariance_.set(n, n + 1, 0.5 * (own(0, 1) + own(1, 0)));
  covariance_.set(n + 1, n + 1, own(1, 1));

  x_.data()[n] = x_.data()[kPosition] + offset.x();
  x_.data()[n + 1] = x_.data()[kPosition + 1] + offset.y();
  landmarks_.push_back(landmark);
  landmarks_.back().map_id = next_map_id_++;
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

UpdateResult SlamFilter::merge(std::size_t i, std::size_t j, double sigma_m) {
  const Residual equal = equality_residual(i, j, sigma_m);
  const UpdateResult result = update({&equal, 1});
  if (result != UpdateResult::kUsed) return result;
  const bool i_is_older = landmarks_[i].map_id < landmarks_[j].map_id;
  Landmark& older = landmarks_[i_is_older ? i : j];
  older.times_seen += landmarks_[i_is_older ? j : i].times_seen;
  remove(i_is_older ? j : i);
  return result;
}

Pose2 SlamFilter::pose() const {
  return {x_.data()[kPosition], x_.data()[kPosition + 1], heading()};
}

Eigen::Matrix3d SlamFilter::pose_covariance() const {
  Eigen::Matrix3d P;
  for (std::size_t i = 0; i < kPoseSize; ++i) {
    for (std::size_t j = 0; j < kPoseSize; ++j) {
      P(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = covariance_.at(i, j);
    }
  }
  return P;
}

}  // namespace roomwise::ekf
