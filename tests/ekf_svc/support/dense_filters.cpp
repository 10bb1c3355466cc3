#include "tests/ekf_svc/support/dense_filters.h"

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace roomwise::ekf {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

const Matrix2d kJ = (Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished();
constexpr double kStartVariance = 1e-12;

MatrixXd grown(const MatrixXd& P, const MatrixXd& with_all, const Matrix2d& own) {
  const Index n = P.rows();
  MatrixXd larger(n + 2, n + 2);
  larger << P, with_all.transpose(), with_all, own;
  return larger;
}

struct Gain {
  MatrixXd K;
  MatrixXd P;  // after, in Joseph's form
};

Gain gain(const MatrixXd& P, const MatrixXd& H, const MatrixXd& R) {
  const MatrixXd S = H * P * H.transpose() + R;
  const MatrixXd K = S.ldlt().solve(H * P).transpose();
  const MatrixXd kept = MatrixXd::Identity(P.rows(), P.cols()) - K * H;
  return {K, kept * P * kept.transpose() + K * R * K.transpose()};
}

}  // namespace

TextbookFilter::TextbookFilter()
    : x_(VectorXd::Zero(3)), P_(kStartVariance * MatrixXd::Identity(3, 3)) {}

void TextbookFilter::predict(const MotionIncrement& motion) {
  const Matrix2d R = rotation2(x_(0));
  const Vector2d shift = R * motion.translation_m;
  MatrixXd F = MatrixXd::Identity(P_.rows(), P_.cols());
  F.block<2, 1>(1, 0) = kJ * shift;
  MatrixXd G = MatrixXd::Zero(P_.rows(), 3);
  G(0, 0) = 1.0;
  G.block<2, 2>(1, 1) = R;
  P_ = (F * P_ * F.transpose() + G * motion.covariance * G.transpose()).eval();
  x_(0) = wrap_angle(x_(0) + motion.turn_rad);
  x_.segment<2>(1) += shift;
}

void TextbookFilter::add(const BodyObservation& seen) {
  const Index n = x_.size();
  const Matrix2d R = rotation2(x_(0));
  const Vector2d offset = R * seen.p_robot_m;
  MatrixXd G = MatrixXd::Zero(2, n);
  G.col(0) = kJ * offset;
  G.block<2, 2>(0, 1) = Matrix2d::Identity();
  P_ = grown(P_, G * P_, G * P_ * G.transpose() + R * seen.covariance_m2 * R.transpose());
  x_.conservativeResize(n + 2);
  x_.tail<2>() = x_.segment<2>(1) + offset;
}

void TextbookFilter::update(const std::vector<Seen>& seen) {
  const Index m = 2 * static_cast<Index>(seen.size());
  const Matrix2d Rt = rotation2(x_(0)).transpose();
  MatrixXd H = MatrixXd::Zero(m, x_.size());
  MatrixXd noise = MatrixXd::Zero(m, m);
  VectorXd innovation(m);
  for (Index a = 0; a < m; a += 2) {
    const Seen& s = seen[static_cast<std::size_t>(a / 2)];
    const Index f = 3 + 2 * s.landmark;
    const Vector2d offset = x_.segment<2>(f) - x_.segment<2>(1);
    innovation.segment<2>(a) = s.observation.p_robot_m - Rt * offset;
    H.block<2, 1>(a, 0) = -Rt * kJ * offset;
    H.block<2, 2>(a, 1) = -Rt;
    H.block<2, 2>(a, f) = Rt;
    noise.block<2, 2>(a, a) = s.observation.covariance_m2;
  }
  const Gain g = gain(P_, H, noise);
  x_ += g.K * innovation;
  x_(0) = wrap_angle(x_(0));
  P_ = g.P;
}

LieFilter::LieFilter()
    : X_(MatrixXd::Identity(3, 3)), P_(kStartVariance * MatrixXd::Identity(3, 3)) {}

void LieFilter::predict(const MotionIncrement& motion) {
  const Matrix2d R = X_.topLeftCorner<2, 2>();
  X_.block<2, 1>(0, 2) += R * motion.translation_m;
  X_.topLeftCorner<2, 2>() = R * rotation2(motion.turn_rad);
  MatrixXd G = MatrixXd::Zero(P_.rows(), 3);
  G(0, 0) = 1.0;
  for (Index column = 2; column < X_.cols(); ++column) {
    G.block<2, 1>(2 * column - 3, 0) = -kJ * X_.block<2, 1>(0, column);
  }
  G.block<2, 2>(1, 1) = R;
  P_ += G * motion.covariance * G.transpose();
}

void LieFilter::add(const BodyObservation& seen) {
  const Matrix2d R = X_.topLeftCorner<2, 2>();
  const Index k = X_.cols();
  const Vector2d f = X_.block<2, 1>(0, 2) + R * seen.p_robot_m;
  X_.conservativeResize(k + 1, k + 1);
  X_.row(k).setZero();
  X_.col(k).setZero();
  X_(k, k) = 1.0;
  X_.block<2, 1>(0, k) = f;
  const MatrixXd with_all = P_.middleRows<2>(1);
  P_ = grown(P_, with_all, P_.block<2, 2>(1, 1) + R * seen.covariance_m2 * R.transpose());
}

void LieFilter::update(const std::vector<Seen>& seen) {
  const Index m = 2 * static_cast<Index>(seen.size());
  const Matrix2d Rt = X_.topLeftCorner<2, 2>().transpose();
  MatrixXd H = MatrixXd::Zero(m, P_.rows());
  MatrixXd noise = MatrixXd::Zero(m, m);
  VectorXd innovation(m);
  for (Index a = 0; a < m; a += 2) {
    const Seen& s = seen[static_cast<std::size_t>(a / 2)];
    const Index column = 3 + s.landmark;
    innovation.segment<2>(a) =
        s.observation.p_robot_m - Rt * (X_.block<2, 1>(0, column) - X_.block<2, 1>(0, 2));
    H.block<2, 2>(a, 1) = -Rt;
    H.block<2, 2>(a, 3 + 2 * s.landmark) = Rt;
    noise.block<2, 2>(a, a) = s.observation.covariance_m2;
  }
  const Gain g = gain(P_, H, noise);
  const VectorXd xi = g.K * innovation;
  MatrixXd algebra = MatrixXd::Zero(X_.rows(), X_.cols());
  algebra.topLeftCorner<2, 2>() = xi(0) * kJ;
  for (Index column = 2; column < X_.cols(); ++column) {
    algebra.block<2, 1>(0, column) = xi.segment<2>(2 * column - 3);
  }
  X_ = (algebra.exp() * X_).eval();
  P_ = g.P;
}

VectorXd LieFilter::state() const {
  VectorXd x(P_.rows());
  x(0) = std::atan2(X_(1, 0), X_(0, 0));
  for (Index column = 2; column < X_.cols(); ++column) {
    x.segment<2>(2 * column - 3) = X_.block<2, 1>(0, column);
  }
  return x;
}

/// Additive error = (I + u 1^T) xi with u = (0, J p, J f_1, ...).
MatrixXd LieFilter::covariance() const {
  MatrixXd T = MatrixXd::Identity(P_.rows(), P_.cols());
  for (Index column = 2; column < X_.cols(); ++column) {
    T.block<2, 1>(2 * column - 3, 0) = kJ * X_.block<2, 1>(0, column);
  }
  return T * P_ * T.transpose();
}

}  // namespace roomwise::ekf
