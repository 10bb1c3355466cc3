#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/chain_profile.h"
#include "services/landmark_svc/core/color_weight.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/edge_pixel.h"
#include "services/landmark_svc/core/landmark.h"
#include "services/landmark_svc/core/line_fit.h"
#include "services/landmark_svc/core/reject_counts.h"
#include "services/landmark_svc/core/surface_plane.h"

namespace roomwise::landmark {

/// What a chain must be to become a landmark, and how sure its position is.
struct ChainEstimateParams {
  double rows_min_px = 18.0;  ///< at 480 px image height
  double height_span_min_m = 0.08;
  double column_rms_max_px = 3.0;  ///< about its line, at 640 px image width
  double lean_max_rad = 0.14;      ///< from the vertical
  double lateral_noise_px = 1.0;   ///< sigma of an edge's column
  /// Sigma of what repeats from row to row and from frame to frame: an outline's place on a thing
  /// that is not sharp, 1 to 1.5 cm. A filter takes every frame for news, so it is said to be more.
  double lateral_bias_m = 0.02;
  double depth_noise_quanta = 1.0;  ///< sigma of one row's depth
  /// Likewise along the ray: the side of a door jamb too narrow to be told from its front, the
  /// half of a chair leg turned away. It changes with the distance, so a filter takes it for
  /// motion.
  double depth_bias_m = 0.15;
  RoundParams round;
};

/// Turns chains of edge pixels into landmarks.
///
/// The near surface's disparity is fitted as a plane over rows and pixels from the edge (as deep as
/// it is straight, at most 9, trimmed once) and extended to the edge line, half a pixel outside
/// the near pixels. Each row then gives a point; lateral and along-ray position against height are
/// fitted as lines, trimmed once. Their means are the landmark, their slopes its lean, the scatter
/// its raggedness. Position sigmas, from which the range-bearing covariance follows by its
/// Jacobian:
///   lateral^2 = (lateral_noise_px z / f)^2 + lateral_bias_m^2
///   along^2   = (q depth_noise)^2 / min(rows, 9) + (q slope lateral_noise_px)^2 + depth_bias_m^2
/// with q = z^2 / (8 f b) the depth of a quantum and slope the near surface's, in quanta a column:
/// on a side seen at a grazing angle a small error of the column is a large one of depth.
///
/// Where the near surface is round (ChainProfile) the landmark is a pole at the circle's centre, or
/// none if the circle is wide: such an outline moves with the viewpoint.
class ChainEstimator {
 public:
  /// Everything of a frame an estimate needs; must outlive the calls.
  struct Scene {
    const DepthImage& depth;
    const PinholeCamera& camera;
    const Eigen::Isometry3d& T_robot_camera;
    const DisparityTable& table;
    const ColorAtDepth& color;
    const ColorWeightParams& color_params;
  };

  /// Writes `landmark` and returns nothing, or returns why `chain` (pixels of one side, rows
  /// descending) is none. Allocates only if the chain is longer than any before.
  [[nodiscard]] std::optional<RejectReason> estimate(const Scene& scene,
                                                     std::span<const EdgePixel> chain,
                                                     const ChainEstimateParams& params,
                                                     Landmark& landmark);

  /// Makes room for chains of an image of so many rows.
  void reserve(int height_px);

 private:
  /// One row's point of the edge, relative to the camera: along the horizontal viewing direction,
  /// to its left, and above the floor.
  struct EdgePoint {
    double along_m;
    double lateral_m;
    double height_m;
    bool kept;
  };
  /// Disparity of one row's near surface, in parts, from the near pixel inwards.
  using NearRow = std::array<std::uint16_t, kNearRunMax_px>;
  /// Relative to the pixel after the edge's own.
  struct MeanProfile {
    std::array<double, kNearRunMax_px> parts{};
    std::size_t end = 1;  ///< half of the rows go on so far
  };
  static constexpr std::size_t kStraight_px = 3;  ///< fewer pixels are always straight
  struct Straight {
    LineFit line;     ///< parts by pixels from the edge
    int last_px = 0;  ///< from the edge
  };
  /// Which pixels of the near surface to use, counted from the row's edge.
  struct Inside {
    int first_px;
    int last_px;
  };
  /// Where the chain is seen, before anything is fitted.
  struct Middle {
    double u_px;
    double v_px;
    Eigen::Vector2d forward;  ///< horizontal unit vector from the camera to it, robot frame
  };
  struct Lines;

  static std::optional<Middle> find_middle(const Scene& scene, std::span<const EdgePixel> chain);
  static bool is_vertical(const Lines& lines, double depth_sigma_m, double lean_max_rad);
  static void describe_position(const Scene& scene, const Middle& middle, const Lines& lines,
                                double along_variance_m2, const ChainEstimateParams& params,
                                Landmark& landmark);
  static void describe_look(const Scene& scene, std::span<const EdgePixel> chain,
                            Landmark& landmark);
  /// Fills points_ from near_rows_. Returns the near surface's slope in quanta a column; nothing if
  /// there is no fit.
  std::optional<double> place_points(const Scene& scene, std::span<const EdgePixel> chain,
                                     const Middle& middle);
  void gather_near_rows(const Scene& scene, std::span<const EdgePixel> chain);
  MeanProfile mean_profile(std::span<const EdgePixel> chain) const;
  static Straight straight_from(const MeanProfile& profile, std::size_t first);
  Inside inside_of(std::span<const EdgePixel> chain, double misplaced_px) const;
  SurfacePlane near_plane(std::span<const EdgePixel> chain, const Middle& middle,
                          const Inside& inside, const SurfacePlane* trimmed_about) const;
  Lines fit_lines() const;
  void trim(const Lines& lines, double smallest_m);

  std::optional<RejectReason> look_for_round(const Scene& scene, std::span<const EdgePixel> chain,
                                             const Middle& middle,
                                             const ChainEstimateParams& params, Landmark& landmark);

  ChainProfile profile_;
  std::vector<NearRow> near_rows_;  // of each pixel of the chain
  std::vector<EdgePoint> points_;   // likewise
};

}  // namespace roomwise::landmark
