// The measurement side of SlamFilter: residuals, and the correction in one sweep.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "services/ekf_svc/core/planar_group.h"
#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {
namespace {

// Below any variance a sensor of this size reaches; keeps rounding from making one negative.
constexpr double kVarianceFloor = 1e-14;

constexpr std::size_t kCorrection = 0;  // scratch vectors
constexpr std::size_t kTilt = 1;        // g
constexpr std::size_t kSwing = 2;       // d

/// In place, lower triangle: matrix = L L^T. False if it is not positive definite.
template <class Matrix>
bool cholesky(Matrix& matrix, std::size_t dimension) {
  for (std::size_t j = 0; j < dimension; ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      for (std::size_t i = j; i < dimension; ++i) matrix[i][j] -= matrix[i][k] * matrix[j][k];
    }
    if (!(matrix[j][j] > 0.0) || !std::isfinite(matrix[j][j])) return false;
    const double pivot = std::sqrt(matrix[j][j]);
    for (std::size_t i = j; i < dimension; ++i) matrix[i][j] /= pivot;
  }
  return true;
}

/// A residual's H: where its columns stand, and what they hold. Those of the range calibration come
/// last, and most residuals have none.
struct SparseJacobian {
  std::array<std::size_t, 7> columns;
  Eigen::Matrix<double, 2, 7> values;
  std::size_t count;
};

SparseJacobian sparse(const Residual& residual) {
  const auto& [a, b] = residual.points;
  constexpr std::size_t kRanges = SlamFilter::kRangeCalibration;
  SparseJacobian H{
      {SlamFilter::kHeading, a.index, a.index + 1, b.index, b.index + 1, kRanges, kRanges + 1},
      {},
      residual.calibration.isZero(0.0) ? 5U : 7U};
  H.values << residual.heading, a.value, b.value, residual.calibration;
  return H;
}

bool residual_is_finite(const Residual& residual) {
  return residual.innovation.allFinite() && residual.noise.allFinite() &&
         residual.softening.allFinite() && residual.heading.allFinite() &&
         residual.calibration.allFinite();
}

bool is_softened(const Residual& residual) { return !residual.softening.isZero(0.0); }

/// To the lower triangle of S.
template <class Matrix>
void add_softening(std::span<const Residual> residuals, Matrix& S) {
  for (std::size_t a = 0; a < residuals.size(); ++a) {
    const Eigen::Matrix2d& softening = residuals[a].softening;
    S[2 * a][2 * a] += softening(0, 0);
    S[2 * a + 1][2 * a] += softening(1, 0);
    S[2 * a + 1][2 * a + 1] += softening(1, 1);
  }
}

/// |L^-1 innovation|^2.
template <class Matrix, class Vector>
double normalised_squared(const Matrix& L, Vector innovation, std::size_t dimension) {
  double squared = 0.0;
  for (std::size_t k = 0; k < dimension; ++k) {
    for (std::size_t l = 0; l < k; ++l) innovation[k] -= L[k][l] * innovation[l];
    innovation[k] /= L[k][k];
    squared += innovation[k] * innovation[k];
  }
  return squared;
}

}  // namespace

Residual SlamFilter::observation_residual(std::size_t l, const BodyObservation& seen) const {
  const std::size_t index = landmark_index(l);
  const Eigen::Matrix2d to_robot = rotation2(-heading());
  const Eigen::Vector2d offset = point(index) - point(kPosition);
  return {.innovation = seen.p_robot_m - to_robot * offset,
          .noise = seen.covariance_m2,
          .heading = -(to_robot * quarter_turn(offset)),
          .calibration = seen.per_calibration,
          .points = {{{kPosition, -to_robot}, {index, to_robot}}}};
}

Residual SlamFilter::equality_residual(std::size_t i, std::size_t j, double sigma_m) const {
  const Eigen::Matrix2d to_robot = rotation2(-heading());
  const Eigen::Vector2d apart = landmark_position_m(i) - landmark_position_m(j);
  return {.innovation = -(to_robot * apart),
          .noise = sigma_m * sigma_m * Eigen::Matrix2d::Identity(),
          .heading = -(to_robot * quarter_turn(apart)),
          .points = {{{landmark_index(i), to_robot}, {landmark_index(j), -to_robot}}}};
}

Eigen::Matrix2d SlamFilter::cross_covariance(const Residual& a, const Residual& b) const {
  const SparseJacobian H_a = sparse(a), H_b = sparse(b);
  Eigen::Matrix<double, 7, 7> P = Eigen::Matrix<double, 7, 7>::Zero();
  for (std::size_t i = 0; i < H_a.count; ++i) {
    for (std::size_t j = 0; j < H_b.count; ++j) {
      P(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          covariance_.at(H_a.columns[i], H_b.columns[j]);
    }
  }
  return H_a.values * P * H_b.values.transpose();
}

Eigen::Matrix2d SlamFilter::innovation_covariance(const Residual& residual) const {
  return cross_covariance(residual, residual) + residual.noise;
}

UpdateResult SlamFilter::update(std::span<const Residual> residuals) {
  if (residuals.size() > kResidualsMax) throw std::logic_error("SlamFilter: too many residuals");
  if (residuals.empty()) return UpdateResult::kUsed;
  if (!std::all_of(residuals.begin(), residuals.end(), residual_is_finite))
    return UpdateResult::kNotFinite;

  const std::size_t dimension = 2 * residuals.size();
  InnovationMatrix S;
  std::array<double, kDimensionMax> innovation;
  for (std::size_t a = 0; a < residuals.size(); ++a) {
    gather_gain(residuals[a], gain(2 * a), gain(2 * a + 1));
    innovation[2 * a] = residuals[a].innovation.x();
    innovation[2 * a + 1] = residuals[a].innovation.y();
  }
  fill_innovation_covariance(residuals, S);
  if (!cholesky(S, dimension)) return UpdateResult::kSingular;
  const double squared = normalised_squared(S, innovation, dimension);
  if (std::any_of(residuals.begin(), residuals.end(), is_softened)) {
    fill_innovation_covariance(residuals, S);
    add_softening(residuals, S);
    if (!cholesky(S, dimension)) return UpdateResult::kSingular;
  }
  whiten(dimension, S, innovation.data());
  correct(dimension, innovation.data());
  last_innovation_ = {squared, static_cast<int>(dimension)};
  return UpdateResult::kUsed;
}

/// The residual's two columns of P H^T.
void SlamFilter::gather_gain(const Residual& residual, double* first, double* second) {
  const std::size_t n = size();
  std::fill(first, first + n, 0.0);
  std::fill(second, second + n, 0.0);
  const auto accumulate = [&](std::size_t index, const Eigen::Vector2d& weight) {
    double* column = scratch(0);
    covariance_.copy_column(index, n, column);
    for (std::size_t i = 0; i < n; ++i) {
      first[i] += weight.x() * column[i];
      second[i] += weight.y() * column[i];
    }
  };
  accumulate(kHeading, residual.heading);
  if (!residual.calibration.isZero(0.0)) {
    accumulate(kRangeCalibration, residual.calibration.col(0));
    accumulate(kRangeCalibration + 1, residual.calibration.col(1));
  }
  for (const JacobianBlock& block : residual.points) {
    accumulate(block.index, block.value.col(0));
    accumulate(block.index + 1, block.value.col(1));
  }
}

/// S = H (P H^T) + noise, lower triangle.
void SlamFilter::fill_innovation_covariance(std::span<const Residual> residuals,
                                            InnovationMatrix& S) {
  for (std::size_t a = 0; a < residuals.size(); ++a) {
    const Residual& residual = residuals[a];
    for (std::size_t c = 0; c < 2 * (a + 1); ++c) {
      const double* g = gain(c);
      Eigen::Vector2d row = residual.heading * g[kHeading];
      row += residual.calibration * Eigen::Vector2d(g[kRangeCalibration], g[kRangeCalibration + 1]);
      for (const JacobianBlock& block : residual.points) {
        row += block.value * Eigen::Vector2d(g[block.index], g[block.index + 1]);
      }
      if (c / 2 == a) row += residual.noise.col(static_cast<Eigen::Index>(c % 2));
      S[2 * a][c] = row.x();
      S[2 * a + 1][c] = row.y();
    }
  }
}

/// gains = P H^T L^-T and innovation = L^-1 innovation, by forward substitution.
void SlamFilter::whiten(std::size_t dimension, const InnovationMatrix& L, double* innovation) {
  const std::size_t n = size();
  const std::size_t n_padded = CovarianceStore::padded(n);
  for (std::size_t k = 0; k < dimension; ++k) {
    double* w = gain(k);
    for (std::size_t l = 0; l < k; ++l) {
      const double* earlier = gain(l);
      for (std::size_t i = 0; i < n; ++i) w[i] -= L[k][l] * earlier[i];
      innovation[k] -= L[k][l] * innovation[l];
    }
    for (std::size_t i = 0; i < n; ++i) w[i] /= L[k][k];
    innovation[k] /= L[k][k];
    std::fill(w + n, w + n_padded, 0.0);
  }
}

void SlamFilter::correct(std::size_t dimension, const double* whitened) {
  const std::size_t n = size();
  double* correction = scratch(kCorrection);
  std::fill(correction, correction + n, 0.0);
  for (std::size_t k = 0; k < dimension; ++k) {
    for (std::size_t i = 0; i < n; ++i) correction[i] += whitened[k] * gain(k)[i];
  }
  if (map_is_fixed_) return correct_robot(dimension, correction);
  retract(correction);
  sweep(dimension);
}

/// Moves the state by the correction, and leaves g in its scratch vector.
void SlamFilter::retract(const double* correction) {
  const std::size_t n = size();
  double* x = x_.data();
  double* g = scratch(kTilt);
  std::fill(g, g + CovarianceStore::padded(n), 0.0);
  const double turn = correction[kHeading];
  x[kHeading] = wrap_angle(x[kHeading] + turn);
  for (std::size_t i = kCalibration; i < kRobotSize; ++i) x[i] += correction[i];
  const Eigen::Matrix2d V =
      form_ == ErrorForm::kInvariant ? arc_matrix(turn) : Eigen::Matrix2d::Identity();
  retract_point(kPosition, V, correction);
  for (std::size_t i = kRobotSize; i < n; i += 2) retract_point(i, V, correction);
}

void SlamFilter::retract_point(std::size_t i, const Eigen::Matrix2d& V, const double* correction) {
  // R(a) q - V(a) J q a = q, because V(a) J a = R(a) - I.
  const Eigen::Vector2d moved_by = V * Eigen::Vector2d(correction[i], correction[i + 1]);
  x_.data()[i] += moved_by.x();
  x_.data()[i + 1] += moved_by.y();
  if (form_ != ErrorForm::kInvariant) return;
  scratch(kTilt)[i] = -moved_by.y();
  scratch(kTilt)[i + 1] = moved_by.x();
}

/// The robot's share of the correction and of P - W W^T; the map stays as it is. The map tells
/// where the world's origin is, so that there is nothing for the invariant form to protect.
void SlamFilter::correct_robot(std::size_t dimension, const double* correction) {
  double* x = x_.data();
  for (std::size_t i = 0; i < kRobotSize; ++i) x[i] += correction[i];
  x[kHeading] = wrap_angle(x[kHeading]);
  for (std::size_t i = 0; i < kRobotSize; ++i) {
    double* row = covariance_.row(i);
    for (std::size_t k = 0; k < dimension; ++k) {
      const double* w = gain(k);
      for (std::size_t j = i; j < size(); ++j) row[j] -= w[i] * w[j];
    }
    row[i] = std::max(row[i], i < kPoseSize ? kVarianceFloor : 0.0);
  }
}

void SlamFilter::sweep(std::size_t dimension) {
  const std::size_t n = size();
  std::array<SweepTerm, kDimensionMax + 2> terms;
  for (std::size_t k = 0; k < dimension; ++k) terms[k] = {gain(k), gain(k), -1.0};
  std::size_t term_count = dimension;
  if (form_ == ErrorForm::kInvariant) {
    const double* g = scratch(kTilt);
    double* d = scratch(kSwing);
    covariance_.copy_column(kHeading, n, d);
    for (std::size_t k = 0; k < dimension; ++k) {
      const double weight = gain(k)[kHeading];
      for (std::size_t i = 0; i < n; ++i) d[i] -= weight * gain(k)[i];
    }
    const double half_variance = 0.5 * d[kHeading];
    for (std::size_t i = 0; i < n; ++i) d[i] += half_variance * g[i];
    std::fill(d + n, d + CovarianceStore::padded(n), 0.0);
    terms[term_count++] = {g, d, 1.0};
    terms[term_count++] = {d, g, 1.0};
  }
  sweep_upper(covariance_.data(), covariance_.stride(), n, {terms.data(), term_count});
  for (std::size_t i = 0; i < n; ++i) {
    const bool may_be_exact = i >= kCalibration && i < kRobotSize;
    covariance_.set(i, i, std::max(covariance_.at(i, i), may_be_exact ? 0.0 : kVarianceFloor));
  }
}

}  // namespace roomwise::ekf
