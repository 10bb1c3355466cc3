#include "services/landmark_svc/core/landmark_detector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "services/landmark_svc/core/automatic_range.h"
#include "services/landmark_svc/core/landmark_pieces.h"
#include "services/landmark_svc/core/player_mask.h"
#include "services/landmark_svc/core/thin_things.h"

namespace roomwise::landmark {
namespace {

bool has_side(int px) { return px >= 1 && px <= kImageSideMax_px; }

DetectResult check(const RgbdFrame& frame) {
  const DepthImage& depth = frame.depth;
  if (!has_side(depth.width_px) || !has_side(depth.height_px) ||
      depth.size() !=
          static_cast<std::size_t>(depth.width_px) * static_cast<std::size_t>(depth.height_px)) {
    return DetectResult::kBadImage;
  }
  if (!frame.players.empty() && frame.players.size() != depth.size()) {
    return DetectResult::kBadImage;
  }
  if (!std::isfinite(depth.unit_m) || !(depth.unit_m > 0.0)) return DetectResult::kBadUnit;
  const PinholeCamera& camera = frame.depth_camera;
  if (!(camera.fx_px > 0.0 && camera.fy_px > 0.0) || !std::isfinite(camera.fx_px) ||
      !std::isfinite(camera.fy_px) || !std::isfinite(camera.cx_px) ||
      !std::isfinite(camera.cy_px)) {
    return DetectResult::kBadCamera;
  }
  return frame.T_robot_camera.matrix().allFinite() ? DetectResult::kOk : DetectResult::kBadPose;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

}  // namespace

LandmarkDetector::LandmarkDetector(const LandmarkParams& params) : params_(params) {
  require(params.jump.range_min_m < params.jump.range_max_m,
          "range_min_m must be smaller than range_max_m");
  require(params.slope.range_min_m < params.slope.range_max_m,
          "thesis_range_min_m must be smaller than thesis_range_max_m");
  require(params.color.dark_luma_levels < params.color.light_luma_levels,
          "dark_luma_levels must be smaller than light_luma_levels");
}

DetectResult LandmarkDetector::detect(const RgbdFrame& frame,
                                      const std::optional<Pose2>& T_odom_robot) {
  const DetectResult result = check(frame);
  if (result != DetectResult::kOk) return result;
  find_edges(frame);
  find_landmarks(frame);
  mark_moving(frame, T_odom_robot);
  if (!frame.players.empty()) mark_players(frame);
  return DetectResult::kOk;
}

void LandmarkDetector::mark_players(const RgbdFrame& frame) {
  for (Landmark& landmark : landmarks_) {
    landmark.is_moving =
        landmark.is_moving || is_on_player(landmark, frame.players, frame.depth.width_px);
  }
}

void LandmarkDetector::mark_moving(const RgbdFrame& frame,
                                   const std::optional<Pose2>& T_odom_robot) {
  if (!T_odom_robot || !floor_) {
    forget_motion();
    return;
  }
  moving_.update(frame.utime, *T_odom_robot, scan_, frame.depth_camera, frame.depth.width_px,
                 params_.moving);
  for (Landmark& landmark : landmarks_) {
    const Eigen::Vector2d p_m = landmark.range_m * Eigen::Vector2d(std::cos(landmark.bearing_rad),
                                                                   std::sin(landmark.bearing_rad));
    landmark.is_moving = moving_.covers(p_m, params_.moving);
  }
  standing_.remember(frame.utime, *T_odom_robot, landmarks_);
  for (Landmark& landmark : landmarks_) {
    if (standing_.has_stood(frame.utime, *T_odom_robot, landmark, params_.standing)) continue;
    landmark.is_moving = true;
  }
  standing_.remember_doubts(landmarks_);
}

void LandmarkDetector::find_edges(const RgbdFrame& frame) {
  reserve(frame.depth);
  table_.prepare(frame.depth.unit_m, params_.quanta_m());
  color_.attach(frame);
  edges_.clear();
  rejected_.clear();
  const PixelRectangle region =
      region_of_interest(params_.region, frame.depth.width_px, frame.depth.height_px);
  range_max_m_ = range_max_of(frame.depth, region);
  if (params_.is_thesis()) {
    SlopeEdgeParams slope = params_.slope;
    slope.range_max_m = range_max_m_;
    alpha_ratio_ =
        color_.available() ? color_weight_ratio(params_.color, mean_luma_levels(frame.color)) : 0.0;
    slope_finder_.find(frame.depth, table_, color_, region, slope, params_.color, alpha_ratio_,
                       edges_, rejected_);
  } else {
    JumpEdgeParams jump = params_.jump;
    jump.range_max_m = range_max_m_;
    jump_finder_.find(frame.depth, table_, region, jump, edges_, rejected_);
  }
}

double LandmarkDetector::range_min_m() const {
  return params_.is_thesis() ? params_.slope.range_min_m : params_.jump.range_min_m;
}

double LandmarkDetector::range_max_of(const DepthImage& depth, const PixelRectangle& region) const {
  const double most_m = params_.is_thesis() ? params_.slope.range_max_m : params_.jump.range_max_m;
  if (!params_.range_is_automatic) return most_m;
  return std::min(most_m, automatic_range_m(depth, table_, region).value_or(most_m));
}

void LandmarkDetector::find_landmarks(const RgbdFrame& frame) {
  landmarks_.clear();
  find_chains(frame);
  if (!params_.is_thesis()) find_creases(frame);
  // Joining compares all with all, so no more than the budget could ever use go into it.
  const auto budget = static_cast<std::size_t>(params_.landmarks_max);
  keep_best(landmarks_, 4 * budget, rejected_);
  join_pieces(landmarks_, params_.join_gate_mahalanobis_sq, rejected_);
  join_thin_things(landmarks_, frame.depth, table_, params_.thin_width_max_m);
  drop_creases_at_edges(landmarks_, rejected_);
  keep_best(landmarks_, budget, rejected_);
}

void LandmarkDetector::find_creases(const RgbdFrame& frame) {
  const DepthImage& depth = frame.depth;
  floor_ = floor_fitter_.fit(depth, frame.depth_camera, table_, frame.T_robot_camera);
  scan_.clear();
  if (!floor_) return;
  scan_.make(depth, frame.depth_camera, table_, *floor_, frame.T_robot_camera,
             region_of_interest(params_.region, depth.width_px, depth.height_px), params_.scan);
  crease_finder_.find(scan_, *floor_, frame.depth_camera, table_, depth.width_px, params_.crease,
                      landmarks_, rejected_);
}

void LandmarkDetector::find_chains(const RgbdFrame& frame) {
  const DepthImage& depth = frame.depth;
  linker_.link(edges_, table_, depth.width_px, depth.height_px, params_.chain);
  linker_.prove_open_edges(edges_, table_, depth.width_px, depth.height_px, params_.chain);
  const ChainEstimator::Scene scene{depth,  frame.depth_camera, frame.T_robot_camera, table_,
                                    color_, params_.color};
  const double bend_max_px = params_.chain.bend_max_px * depth.width_px / 640.0;
  const auto is_open = [](const EdgePixel& edge) { return edge.is_open; };
  const auto rows_min =
      static_cast<std::size_t>(params_.estimate.rows_min_px * depth.height_px / 480.0);
  for (const EdgeChain& chain : linker_.chains()) {
    linker_.collect(chain, edges_, chain_pixels_);
    std::erase_if(chain_pixels_, is_open);
    split_at_bends(chain_pixels_, bend_max_px, rows_min, pieces_);
    for (const ChainPiece& piece : pieces_) {
      try_chain(scene, std::span(chain_pixels_).subspan(piece.begin, piece.end - piece.begin));
    }
  }
  std::erase_if(edges_, is_open);
}

void LandmarkDetector::try_chain(const ChainEstimator::Scene& scene,
                                 std::span<const EdgePixel> chain) {
  Landmark landmark;
  const auto reason = estimator_.estimate(scene, chain, params_.estimate, landmark);
  if (reason) {
    rejected_.add(*reason);
  } else {
    landmarks_.push_back(landmark);
  }
}

void LandmarkDetector::reserve(const DepthImage& depth) {
  // No pixel is an edge twice. Untouched memory costs nothing.
  if (edges_.capacity() >= depth.size()) return;
  const auto rows = static_cast<std::size_t>(depth.height_px);
  edges_.reserve(depth.size());
  linker_.reserve(depth.size(), depth.width_px);
  estimator_.reserve(depth.height_px);
  chain_pixels_.reserve(rows);
  pieces_.reserve(rows);
  // A chain has three edges, a crease a column of its own.
  const auto columns = static_cast<std::size_t>(depth.width_px);
  landmarks_.reserve(depth.size() / 3 + 1 + columns);
  floor_fitter_.reserve(depth.width_px, depth.height_px);
  scan_.reserve(depth.width_px);
  crease_finder_.reserve(columns);
  moving_.reserve(depth.width_px);
  standing_.reserve(static_cast<std::size_t>(params_.landmarks_max));
}

}  // namespace roomwise::landmark
