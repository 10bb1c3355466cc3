#pragma once
#include <array>
#include <cstddef>

#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

/// Normalised innovation squared of several residuals together, built up one by one: with L and y
/// of those so far (S = L L^T, y = L^-1 innovation), a new one of covariance S_n and cross
/// covariance C has w = L^-1 C, Sigma = S_n - w^T w, v = innovation - w^T y, and adds
/// v^T Sigma^-1 v. So each residual is judged given the others, however much they all share of the
/// error of the robot's pose.
///
/// Source: Neira, Tardos, "Data association in stochastic mapping using the joint compatibility
/// test", IEEE TRA 2001.
class JointGate {
 public:
  static constexpr std::size_t kPairsMax = SlamFilter::kResidualsMax;

  explicit JointGate(const SlamFilter& filter) : filter_(&filter) {}

  /// What `residual` adds given those taken in; infinite when full, or if S would not be positive
  /// definite. O(pairs^2).
  double cost(const Residual& residual);

  /// Takes the residual in and returns what it adds. Infinity: it was not taken in. `residual` must
  /// outlive its stay.
  double push(const Residual& residual);
  void pop() { --count_; }
  void clear() { count_ = 0; }
  std::size_t pairs() const { return count_; }

 private:
  static constexpr std::size_t kDimensionMax = 2 * kPairsMax;
  const SlamFilter* filter_;
  std::size_t count_ = 0;
  std::array<const Residual*, kPairsMax> residuals_{};
  std::array<std::array<double, kDimensionMax>, kDimensionMax> L_{};  // rows past count_: scratch
  std::array<double, kDimensionMax> y_{};
};

}  // namespace roomwise::ekf
