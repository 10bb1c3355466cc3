#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace roomwise::landmark {

/// Which physical thing a landmark is; the values are those of landmark_observation_t.
enum class LandmarkKind : std::int8_t {
  kEdgeLeft = 1,
  kEdgeRight = 2,
  kCreaseConvex = 3,
  kCreaseConcave = 4,
  kPole = 5,  ///< position is the centre
};

/// Colour of a surface apart from its brightness.
struct ChromaSignature {
  double red_log = 0.0;   ///< ln(R / G)
  double blue_log = 0.0;  ///< ln(B / G)
  /// Variance of either: kNoColorVariance_log2 where there is no colour or it is too dark to tell.
  double variance_log2 = kNoColorVariance_log2;

  static constexpr double kNoColorVariance_log2 = 1e6;
};

/// Something upright seen in one frame, as a point in the floor plane of the robot frame.
struct Landmark {
  LandmarkKind kind = LandmarkKind::kEdgeLeft;
  double range_m = 0.0;      ///< > 0, from the robot frame's origin
  double bearing_rad = 0.0;  ///< [-pi, pi), counter-clockwise from robot x
  /// Of (range, bearing). Shape 2 x 2, [m^2, m rad; m rad, rad^2].
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double height_low_m = 0.0;  ///< span seen, above the floor
  double height_high_m = 0.0;
  double step_m = 0.0;  ///< mean depth jump to what lies behind
  ChromaSignature chroma;
  double score_ratio = 0.0;  ///< [0, 1]
  int rows = 0;              ///< image rows that support it
  double u_px = 0.0;         ///< mean column of the edge line, half a pixel outside the near pixels
  double v_top_px = 0.0;
  double v_bottom_px = 0.0;
  double column_slope = 0.0;  ///< of an edge: columns a row
  double depth_m = 0.0;       ///< of an edge: mean depth of its near pixels
  bool is_moving = false;     ///< on something that moves, a person, or not yet seen to stand still
};

/// Sets range, bearing and their covariance from a place in the robot frame and its covariance in
/// x and y, by the Jacobian of the change to polar coordinates.
void set_position(Landmark& landmark, const Eigen::Vector2d& p_robot_m,
                  const Eigen::Matrix2d& covariance_m2);

}  // namespace roomwise::landmark
