#pragma once
#include <Eigen/Dense>
#include <vector>

#include "services/ekf_svc/core/body_observation.h"
#include "services/ekf_svc/core/motion.h"

namespace roomwise::ekf {

/// EKF-SLAM with full matrices, nothing clever: what SlamFilter must agree with. Landmarks are
/// numbered in the order they are added. Errors are ordered (heading, position, landmark 0, ...).
class DenseFilter {
 public:
  struct Seen {
    int landmark;
    BodyObservation observation;
  };
  virtual ~DenseFilter() = default;
  virtual void predict(const MotionIncrement& motion) = 0;
  virtual void add(const BodyObservation& seen) = 0;
  virtual void update(const std::vector<Seen>& seen) = 0;
  virtual Eigen::VectorXd state() const = 0;
  /// Of the additive error of state().
  virtual Eigen::MatrixXd covariance() const = 0;
};

/// The textbook EKF: additive error, Jacobians at the newest estimate.
class TextbookFilter final : public DenseFilter {
 public:
  TextbookFilter();
  void predict(const MotionIncrement& motion) override;
  void add(const BodyObservation& seen) override;
  void update(const std::vector<Seen>& seen) override;
  Eigen::VectorXd state() const override { return x_; }
  Eigen::MatrixXd covariance() const override { return P_; }

 private:
  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
};

/// The right-invariant EKF on the Lie group SE_{1+K}(2): the state is one matrix
/// X = [R p f_1 ... f_K; 0 I], its error the Lie algebra element xi of X_true = exp(xi) X. The
/// exponential is the matrix one, the covariance is kept in xi.
class LieFilter final : public DenseFilter {
 public:
  LieFilter();
  void predict(const MotionIncrement& motion) override;
  void add(const BodyObservation& seen) override;
  void update(const std::vector<Seen>& seen) override;
  Eigen::VectorXd state() const override;
  Eigen::MatrixXd covariance() const override;
  const Eigen::MatrixXd& invariant_covariance() const { return P_; }

 private:
  Eigen::MatrixXd X_;
  Eigen::MatrixXd P_;
};

}  // namespace roomwise::ekf
