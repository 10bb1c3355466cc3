#include "services/ekf_svc/core/constellation_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "services/ekf_svc/core/constellation_closure.h"
#include "services/ekf_svc/core/planar_group.h"

namespace roomwise::ekf {
namespace {

Eigen::Matrix2d block(const MapSnapshot& map, std::size_t a, std::size_t b) {
  Eigen::Matrix2d P;
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t c = 0; c < 2; ++c) {
      P(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          map.covariance(2 * a + r, 2 * b + c);
    }
  }
  return P;
}

/// Covariance of all f_old - T f_recent.
Eigen::MatrixXd residual_covariance(const MapSnapshot& map, const MapSnapshot& local,
                                    std::span<const LandmarkPair> pairs, double heading_rad) {
  const auto n = static_cast<Eigen::Index>(2 * pairs.size());
  const Eigen::Matrix2d R = rotation2(heading_rad);
  constexpr double kVariance_m2 = ConstellationClosure::kSigma_m * ConstellationClosure::kSigma_m;
  Eigen::MatrixXd C = kVariance_m2 * Eigen::MatrixXd::Identity(n, n);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      C.block<2, 2>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(2 * j)) +=
          block(map, pairs[i].old, pairs[j].old) +
          R * block(local, pairs[i].recent, pairs[j].recent) * R.transpose();
    }
  }
  return C;
}

/// ln of the integral over the motion of a Gaussian of covariance C, least at `squared`.
double log_density(const Eigen::LDLT<Eigen::MatrixXd>& C, const Eigen::Matrix3d& information,
                   double squared) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto freedom = static_cast<double>(C.rows() - information.rows());
  return -0.5 * (squared + freedom * std::log(kTurn) + C.vectorD().array().log().sum() +
                 std::log(information.determinant()));
}

}  // namespace

ConstellationFit fit_constellation(const MapSnapshot& map, const MapSnapshot& local,
                                   std::span<const LandmarkPair> pairs, const Pose2& T_map_local) {
  const auto n = static_cast<Eigen::Index>(2 * pairs.size());
  ConstellationFit fit{.T_map_local = T_map_local};
  const Eigen::LDLT<Eigen::MatrixXd> C(
      residual_covariance(map, local, pairs, T_map_local.heading_rad));
  Eigen::MatrixXd H(n, 3);
  Eigen::VectorXd r(n);
  constexpr int kSteps = 2;
  for (int step = 0; step <= kSteps; ++step) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      const Eigen::Vector2d p = transform(fit.T_map_local, local.positions_m[pairs[i].recent]);
      r.segment<2>(row) = map.positions_m[pairs[i].old] - p;
      H.block<2, 1>(row, 0) = quarter_turn(p - fit.T_map_local.position_m());
      H.block<2, 2>(row, 1).setIdentity();
    }
    fit.squared = r.dot(C.solve(r));
    const Eigen::Matrix3d information = H.transpose() * C.solve(H);
    fit.covariance = information.inverse();
    if (step == kSteps) {
      fit.log_density = log_density(C, information, fit.squared);
      break;
    }
    const Eigen::Vector3d by = information.ldlt().solve(H.transpose() * C.solve(r));
    fit.T_map_local = {fit.T_map_local.x_m + by(1), fit.T_map_local.y_m + by(2),
                       wrap_angle(fit.T_map_local.heading_rad + by(0))};
  }
  return fit;
}

}  // namespace roomwise::ekf
