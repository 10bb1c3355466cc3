#include "services/ekf_svc/core/joint_gate.h"

#include <cmath>
#include <limits>

namespace roomwise::ekf {

double JointGate::cost(const Residual& residual) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (count_ == kPairsMax) return kInfinite;
  const std::size_t d = 2 * count_;
  for (std::size_t a = 0; a < count_; ++a) {
    const Eigen::Matrix2d cross = filter_->cross_covariance(residual, *residuals_[a]);
    for (std::size_t r = 0; r < 2; ++r) {
      for (std::size_t c = 0; c < 2; ++c) {
        L_[d + r][2 * a + c] = cross(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
      }
    }
  }
  const Eigen::Matrix2d own = filter_->innovation_covariance(residual);
  L_[d][d] = own(0, 0);
  L_[d + 1][d] = own(1, 0);
  L_[d + 1][d + 1] = own(1, 1);
  double squared = 0.0;
  for (std::size_t row = d; row < d + 2; ++row) {
    auto& l = L_[row];
    double v = residual.innovation(static_cast<Eigen::Index>(row - d));
    for (std::size_t c = 0; c < row; ++c) {
      for (std::size_t k = 0; k < c; ++k) l[c] -= l[k] * L_[c][k];
      l[c] /= L_[c][c];
      l[row] -= l[c] * l[c];
      v -= l[c] * y_[c];
    }
    if (!(l[row] > 0.0)) return kInfinite;
    l[row] = std::sqrt(l[row]);
    y_[row] = v / l[row];
    squared += y_[row] * y_[row];
  }
  return std::isfinite(squared) ? squared : kInfinite;
}

double JointGate::push(const Residual& residual) {
  const double added = cost(residual);
  if (std::isfinite(added)) residuals_[count_++] = &residual;
  return added;
}

}  // namespace roomwise::ekf
