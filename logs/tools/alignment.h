#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/geometry/pose2.h"

namespace roomwise {

/// Points in the plane. [m]
using Points2 = std::vector<Eigen::Vector2d>;

/// The rigid motion T_b_a with the least sum of squares of |p_b - T_b_a p_a| over pairs of points
/// of the same index. Of fewer than two distinct points the rotation is not determined and stays 0.
/// Throws std::logic_error if the lists differ in length or are empty.
///
/// Source: Umeyama, "Least-squares estimation of transformation parameters between two point
/// patterns", PAMI 13(4), 1991, without scale; in the plane the rotation is
/// atan2(sum a x b, sum a . b) of the centred points.
Pose2 align_rigidly(const Points2& p_a_m, const Points2& p_b_m);

/// Root of the mean of |p_b - T_b_a p_a|^2. [m]
double rms_distance_m(const Pose2& T_b_a, const Points2& p_a_m, const Points2& p_b_m);

}  // namespace roomwise
