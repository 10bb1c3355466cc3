#pragma once
#include <optional>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/chain_estimator.h"
#include "services/landmark_svc/core/chain_split.h"
#include "services/landmark_svc/core/color_weight.h"
#include "services/landmark_svc/core/crease_finder.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/edge_chains.h"
#include "services/landmark_svc/core/floor_fit.h"
#include "services/landmark_svc/core/jump_edges.h"
#include "services/landmark_svc/core/landmark.h"
#include "services/landmark_svc/core/landmark_params.h"
#include "services/landmark_svc/core/moving_mask.h"
#include "services/landmark_svc/core/reject_counts.h"
#include "services/landmark_svc/core/slope_edges.h"
#include "services/landmark_svc/core/standing.h"
#include "services/landmark_svc/core/virtual_scan.h"

namespace roomwise::landmark {

enum class [[nodiscard]] DetectResult{
    kOk,
    kBadImage,   ///< sizes not in [1, 4096], or the pixels do not fill them
    kBadUnit,    ///< depth unit not positive and finite
    kBadCamera,  ///< focal length not positive, or a number not finite
    kBadPose,    ///< T_robot_camera not finite
};

/// From one frame to its landmarks, O(pixels).
///
/// Edge pixels (JumpEdgeFinder, or SlopeEdgeFinder for method "thesis") are chained down the image
/// (ChainLinker), cut where they bend, made landmarks of (ChainEstimator), and pieces of one edge
/// are joined. Creases come from a virtual scan (VirtualScan, CreaseFinder). Every frame stands
/// alone: nothing is carried over but memory. Holds no clock, draws no random numbers: the same
/// frame gives the same bits. Allocates nothing after the first frame of a size.
class LandmarkDetector {
 public:
  /// Throws std::runtime_error if a range or the two brightness limits are the wrong way round.
  explicit LandmarkDetector(const LandmarkParams& params);

  /// Replaces the results below by those of `frame`. On anything but kOk they are as they were.
  /// With the robot's pose by the odometry at the frame's time, what moves, or has not been seen to
  /// stand still for a moment, is marked;
  /// without, nothing is, and what earlier frames showed is forgotten.
  DetectResult detect(const RgbdFrame& frame,
                      const std::optional<Pose2>& T_odom_robot = std::nullopt);

  /// Forgets where earlier frames were seen from: the odometry started anew.
  void forget_motion() {
    moving_.clear();
    standing_.clear();
  }

  /// From left to right.
  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  /// Row by row, columns ascending.
  const std::vector<EdgePixel>& edges() const { return edges_; }
  /// The slice of the view as a planar scanner would see it.
  const VirtualScan& scan() const { return scan_; }
  /// None if the camera's mounting makes no sense of a floor.
  const std::optional<FloorView>& floor() const { return floor_; }
  const RejectCounts& rejected() const { return rejected_; }

  /// Weight of colour in force on this frame; depth's is 1 - alpha. 0 for method "disparity".
  double alpha_ratio() const { return alpha_ratio_; }

  /// Trusted depths of an edge's near side in force on this frame.
  double range_min_m() const;
  double range_max_m() const { return range_max_m_; }

  const LandmarkParams& params() const { return params_; }

  /// The first stage alone, for benchmarks: edges of a frame detect() would accept.
  void find_edges(const RgbdFrame& frame);

 private:
  void reserve(const DepthImage& depth);
  double range_max_of(const DepthImage& depth, const PixelRectangle& region) const;
  void find_landmarks(const RgbdFrame& frame);
  void find_chains(const RgbdFrame& frame);
  void find_creases(const RgbdFrame& frame);
  void mark_moving(const RgbdFrame& frame, const std::optional<Pose2>& T_odom_robot);
  void mark_players(const RgbdFrame& frame);
  void try_chain(const ChainEstimator::Scene& scene, std::span<const EdgePixel> chain);

  LandmarkParams params_;
  DisparityTable table_;
  ColorAtDepth color_;
  JumpEdgeFinder jump_finder_;
  SlopeEdgeFinder slope_finder_;
  ChainLinker linker_;
  ChainEstimator estimator_;
  FloorFitter floor_fitter_;
  VirtualScan scan_;
  MovingMask moving_;
  Standing standing_;
  CreaseFinder crease_finder_;
  std::optional<FloorView> floor_;
  double alpha_ratio_ = 0.0;
  double range_max_m_ = 0.0;
  std::vector<EdgePixel> edges_;
  std::vector<EdgePixel> chain_pixels_;
  std::vector<ChainPiece> pieces_;
  std::vector<Landmark> landmarks_;
  RejectCounts rejected_;
};

}  // namespace roomwise::landmark
