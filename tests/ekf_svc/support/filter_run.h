#pragma once
#include <Eigen/Dense>
#include <map>
#include <stdexcept>
#include <vector>

#include "services/ekf_svc/core/slam_filter.h"
#include "tests/ekf_svc/support/dense_filters.h"
#include "tests/ekf_svc/support/simulated_world.h"

namespace roomwise::ekf {

inline MotionIncrement increment_of(const MotionStep& step) {
  MotionIncrement motion;
  motion.append(step);
  return motion;
}

/// A SlamFilter at a chosen state: landmarks are seen from the origin, then the robot is moved.
inline SlamFilter filter_at(ErrorForm form, const Pose2& pose,
                            const std::vector<Eigen::Vector2d>& landmarks,
                            const Eigen::Matrix3d& motion_covariance = Eigen::Matrix3d::Zero()) {
  SlamFilter filter(form, landmarks.size() + 4);
  for (const Eigen::Vector2d& p : landmarks) {
    if (!filter.add({p, 0.01 * Eigen::Matrix2d::Identity()}, {})) throw std::logic_error("budget");
  }
  MotionIncrement motion;
  motion.turn_rad = pose.heading_rad;
  motion.translation_m = pose.position_m();
  motion.covariance = motion_covariance;
  filter.predict(motion);
  return filter;
}

/// The filter's numbers of row r when odometry's calibration, fixed here, is left out.
inline std::size_t row_of(Eigen::Index r) {
  const auto i = static_cast<std::size_t>(r);
  return i < SlamFilter::kPoseSize ? i : i + SlamFilter::kRobotSize - SlamFilter::kPoseSize;
}
inline Eigen::Index rows_of(const SlamFilter& filter) {
  return static_cast<Eigen::Index>(filter.size() - SlamFilter::kRobotSize + SlamFilter::kPoseSize);
}

inline Eigen::VectorXd state_of(const SlamFilter& filter) {
  Eigen::VectorXd x(rows_of(filter));
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = filter.state(row_of(i));
  return x;
}

inline Eigen::MatrixXd covariance_of(const SlamFilter& filter) {
  const Eigen::Index n = rows_of(filter);
  Eigen::MatrixXd P(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) P(i, j) = filter.covariance(row_of(i), row_of(j));
  }
  return P;
}

/// Covariance of the right-invariant error, whose update can only lose.
inline Eigen::MatrixXd invariant_covariance_of(const SlamFilter& filter) {
  const Eigen::VectorXd x = state_of(filter);
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(x.size(), x.size());
  for (Eigen::Index i = 1; i < x.size(); i += 2) {
    T(i, 0) = x(i + 1);
    T(i + 1, 0) = -x(i);
  }
  return T * covariance_of(filter) * T.transpose();
}

/// Residual's H as a dense row block, 2 x rows_of(filter).
inline Eigen::MatrixXd dense_jacobian(const Residual& residual, const SlamFilter& filter) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, rows_of(filter));
  H.col(0) = residual.heading;
  for (const JacobianBlock& block : residual.points) {
    for (Eigen::Index r = 0; r < H.cols(); ++r) {
      if (row_of(r) == block.index) H.middleCols<2>(r) += block.value;
    }
  }
  return H;
}

/// Drives filters through one simulated world with known identities; landmarks are numbered in the
/// order they are first seen, the same in every filter.
class KnownIdentityRun {
 public:
  KnownIdentityRun(const WorldSettings& settings, std::uint64_t seed) : world_(settings, seed) {}

  void step(const std::vector<SlamFilter*>& filters, const std::vector<DenseFilter*>& dense) {
    const MotionIncrement motion = increment_of(world_.drive());
    for (SlamFilter* filter : filters) filter->predict(motion);
    for (DenseFilter* filter : dense) filter->predict(motion);

    std::vector<DenseFilter::Seen> known;
    std::vector<BodyObservation> fresh;
    for (const SimulatedWorld::Seen& seen : world_.look()) {
      const BodyObservation body = to_body(seen.polar, 0.0, 0.0);
      const auto [slot, is_new] = number_.emplace(seen.id, static_cast<int>(number_.size()));
      if (is_new) {
        fresh.push_back(body);
      } else {
        known.push_back({slot->second, body});
      }
    }
    for (SlamFilter* filter : filters) use(*filter, known, fresh);
    for (DenseFilter* filter : dense) {
      if (!known.empty()) filter->update(known);
      for (const BodyObservation& body : fresh) filter->add(body);
    }
  }

  const SimulatedWorld& world() const { return world_; }

 private:
  static void use(SlamFilter& filter, const std::vector<DenseFilter::Seen>& known,
                  const std::vector<BodyObservation>& fresh) {
    std::vector<Residual> residuals;
    for (const DenseFilter::Seen& seen : known) {
      residuals.push_back(
          filter.observation_residual(static_cast<std::size_t>(seen.landmark), seen.observation));
    }
    if (filter.update(residuals) != UpdateResult::kUsed) throw std::logic_error("update refused");
    for (const BodyObservation& body : fresh) {
      if (!filter.add(body, {})) throw std::logic_error("budget");
    }
  }

  SimulatedWorld world_;
  std::map<int, int> number_;
};

}  // namespace roomwise::ekf
