#pragma once
#include <Eigen/Core>
#include <vector>

namespace roomwise {

/// Outline of the ellipse that holds 95 % of a Gaussian in the plane: x - mean = sqrt(5.991) L c,
/// with covariance = L L^T and c on the unit circle (chi-square, two degrees of freedom). Empty if
/// `covariance` (2 x 2, [m^2]) is not positive semidefinite.
std::vector<Eigen::Vector2d> ellipse_outline(const Eigen::Vector2d& mean_m,
                                             const Eigen::Matrix2d& covariance_m2);

}  // namespace roomwise
