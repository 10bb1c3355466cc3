#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

namespace roomwise::landmark {

/// A circle in the plane, relative to the camera: x along its level viewing direction, y to its
/// left.
struct TangentCircle {
  Eigen::Vector2d center_m;
  double radius_m = 0.0;
  double rms_m = 0.0;  ///< distance of the points from it
};

/// The circle that fits `points_m` best among those the sight line of the edge touches: where a
/// round thing ends, for the eye, its surface runs along the line of sight. With d that line's unit
/// vector and n the one across it, towards the thing, the centre is s d + r n, so only s and r are
/// to be found: a few Gauss-Newton steps for | |p - c| - r |^2, from three radii.
///
/// `edge_ray` need not be of unit length; `inward_left` says whether the thing lies to its left.
/// Nothing with fewer than 5 points, or if no start leads to 5 mm < r < 3 m.
std::optional<TangentCircle> fit_tangent_circle(std::span<const Eigen::Vector2d> points_m,
                                                const Eigen::Vector2d& edge_ray, bool inward_left);

/// RMS distance of points from their total-least-squares line; 0 for fewer than 2.
double line_rms_m(std::span<const Eigen::Vector2d> points_m);

}  // namespace roomwise::landmark
