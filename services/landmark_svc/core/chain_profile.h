#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/edge_pixel.h"
#include "services/landmark_svc/core/round_profile.h"

namespace roomwise::landmark {

/// When an edge is taken for the outline of something round.
struct RoundParams {
  double arc_m = 0.20;              ///< of the near surface that is looked at
  double pole_radius_min_m = 0.01;  ///< narrower is no circle one can tell
  double pole_radius_max_m = 0.30;  ///< wider is a limb
  double limb_radius_max_m = 1.50;  ///< wider is as good as flat
  double bend_quanta = 0.15;        ///< RMS about a line from which on it can be a curve
  double better_ratio = 0.6;        ///< RMS about the circle, of that about the line, at most
};

enum class ProfileShape { kFlat, kPole, kLimb };

/// The near surface of an edge, averaged over the rows of its chain, from the edge inwards: noise
/// of one row hides a curve, that of 50 does not. Fixed memory.
class ChainProfile {
 public:
  /// Reads the profile. `along_ratio`: level distance over depth at the chain's middle.
  void gather(const DepthImage& depth, const PinholeCamera& camera, const DisparityTable& table,
              std::span<const EdgePixel> chain, double along_ratio, double arc_m);

  /// Whether it is round; the circle then, else `circle` is untouched.
  ProfileShape shape(const DisparityTable& table, const RoundParams& params,
                     TangentCircle& circle) const;

  std::span<const Eigen::Vector2d> points_m() const { return {points_m_.data(), count_}; }

 private:
  static constexpr std::size_t kMost = 96;
  std::array<Eigen::Vector2d, kMost> points_m_;  // x along, y left of the camera
  std::size_t count_ = 0;
  Eigen::Vector2d edge_ray_{1.0, 0.0};
  bool inward_left_ = false;
};

}  // namespace roomwise::landmark
