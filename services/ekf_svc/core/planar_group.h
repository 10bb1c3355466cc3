#pragma once
#include <Eigen/Core>
#include <cmath>

namespace roomwise::ekf {

/// J q: `q` turned by a quarter, counter-clockwise; the derivative of R(e) q at e = 0.
inline Eigen::Vector2d quarter_turn(const Eigen::Vector2d& q) { return {-q.y(), q.x()}; }

/// J = [0 -1; 1 0] as a matrix.
inline Eigen::Matrix2d quarter_turn_matrix() {
  return (Eigen::Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished();
}

/// sin(e)/e and (1 - cos(e))/e with their derivatives; series where the quotients lose digits.
struct ArcCoefficients {
  double along;           ///< sin(e)/e
  double across;          ///< (1 - cos(e))/e
  double along_per_rad;   ///< d along / de
  double across_per_rad;  ///< d across / de
};

inline ArcCoefficients arc_coefficients(double e) {
  if (std::abs(e) < 1e-2) {
    const double e2 = e * e;
    return {1.0 - e2 / 6.0 * (1.0 - e2 / 20.0 * (1.0 - e2 / 42.0)),
            e / 2.0 * (1.0 - e2 / 12.0 * (1.0 - e2 / 30.0)),
            -e / 3.0 * (1.0 - e2 / 10.0 * (1.0 - e2 / 28.0)),
            0.5 - e2 / 8.0 * (1.0 - e2 / 18.0 * (1.0 - e2 / 40.0))};
  }
  const double s = std::sin(e);
  const double half = std::sin(0.5 * e);
  const double along = s / e;
  const double across = 2.0 * half * half / e;
  return {along, across, (std::cos(e) - along) / e, (s - across) / e};
}

/// V(e) = [sin e/e, -(1-cos e)/e; (1-cos e)/e, sin e/e]: what a twist (e, v) held for unit time
/// moves the origin by is V(e) v. Shape 2 x 2.
inline Eigen::Matrix2d arc_matrix(const ArcCoefficients& arc) {
  return (Eigen::Matrix2d() << arc.along, -arc.across, arc.across, arc.along).finished();
}
inline Eigen::Matrix2d arc_matrix(double e) { return arc_matrix(arc_coefficients(e)); }

}  // namespace roomwise::ekf
