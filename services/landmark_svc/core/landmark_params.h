#pragma once
#include <numbers>
#include <string>

#include "services/landmark_svc/core/chain_estimator.h"
#include "services/landmark_svc/core/color_weight.h"
#include "services/landmark_svc/core/crease_finder.h"
#include "services/landmark_svc/core/edge_chains.h"
#include "services/landmark_svc/core/jump_edges.h"
#include "services/landmark_svc/core/moving_mask.h"
#include "services/landmark_svc/core/region_of_interest.h"
#include "services/landmark_svc/core/slope_edges.h"
#include "services/landmark_svc/core/standing.h"

namespace roomwise::landmark {

/// Tuning of the landmark detector; services/landmark_svc/params.toml may override any field.
struct LandmarkParams {
  std::string method = "disparity";        ///< or "thesis": which pixels are edges
  bool use_color = true;                   ///< false: colour is not even decoded
  double baseline_m = 0.075;               ///< projector to camera
  double disparity_focal_px = 585.0;       ///< focal length of the sensor's 640 px matching grid
  bool range_is_automatic = false;         ///< farthest range from each frame's histogram of depths
  int landmarks_max = 64;                  ///< a frame, best scored first
  double join_gate_mahalanobis_sq = 9.21;  ///< chi-square, 2 degrees of freedom, 99 %
  double thin_width_max_m = 0.25;          ///< two edges nearer to each other make one pole
  int edge_pixels_listed_max = 4000;       ///< in the message, evenly thinned; all are counted
  RegionParams region;
  JumpEdgeParams jump{.finds_open = true};
  SlopeEdgeParams slope;
  ColorWeightParams color;
  ChainParams chain;
  ChainEstimateParams estimate;
  VirtualScanParams scan;
  CreaseParams crease;
  MovingParams moving;
  StandingParams standing;

  bool is_thesis() const { return method == "thesis"; }
  /// 8 f b: disparity in quanta times depth in metres.
  double quanta_m() const { return 8.0 * disparity_focal_px * baseline_m; }

  template <class Field>
  void visit_fields(Field&& field) {  // name, member, smallest, largest allowed
    field("method", method, {"disparity", "thesis"});
    field("use_color", use_color);
    field("baseline_m", baseline_m, 0.01, 0.5);
    field("disparity_focal_px", disparity_focal_px, 50.0, 5000.0);
    field("range_is_automatic", range_is_automatic);
    field("landmarks_max", landmarks_max, 0, 200);
    field("join_gate_mahalanobis_sq", join_gate_mahalanobis_sq, 0.0, 100.0);
    field("edge_pixels_listed_max", edge_pixels_listed_max, 0, 8000);
    field("thin_width_max_m", thin_width_max_m, 0.0, 1.0);
    visit_edge_fields(field);
    visit_chain_fields(field);
    visit_scan_fields(field);
  }

 private:
  template <class Field>
  void visit_edge_fields(Field&& field) {
    field("region", region.region,
          {"whole", "slice", "top_left", "top_right", "bottom_left", "bottom_right"});
    field("slice_first_row_px", region.slice_first_row_px, 0, 4095);
    field("slice_rows_px", region.slice_rows_px, 1, 4096);
    field("drop_bottom_rows_px", region.drop_bottom_rows_px, 0, 4096);
    field("jump_quanta", jump.jump_quanta, 1.0, 100.0);
    field("jump_m", jump.jump_m, 0.005, 1.0);
    field("gap_max_px", jump.gap_max_px, 0.0, 640.0);
    field("gap_slope_quanta_px", jump.gap_slope_quanta_px, 0.0, 100.0);
    field("near_run_px", jump.near_run_px, 2, kNearRunMax_px);
    field("far_run_px", jump.far_run_px, 1, 100);
    field("finds_open", jump.finds_open);
    field("range_min_m", jump.range_min_m, 0.0, 4.095);
    field("range_max_m", jump.range_max_m, 0.0, 4.095);
    field("threshold_mm_per_px", slope.threshold_mm_per_px, 0.0, 10000.0);
    field("thesis_range_min_m", slope.range_min_m, 0.0, 4.095);
    field("thesis_range_max_m", slope.range_max_m, 0.0, 4.095);
    field("alpha_max_ratio", color.alpha_max_ratio, 0.0, 1.0);
    field("dark_luma_levels", color.dark_luma_levels, 0.0, 255.0);
    field("light_luma_levels", color.light_luma_levels, 0.0, 255.0);
    field("color_noise_levels", color.noise_levels, 0.1, 100.0);
  }

  template <class Field>
  void visit_chain_fields(Field&& field) {
    field("column_step_max_px", chain.column_step_max_px, 0.0, 64.0);
    field("depth_step_m", chain.depth_step_m, 0.0, 1.0);
    field("depth_step_per_m_m2", chain.depth_step_per_m_m2, 0.0, 1.0);
    field("row_gap_max_px", chain.row_gap_max_px, 0, 100);
    field("proof_rows_px", chain.proof_rows_px, 0, 480);
    field("bend_max_px", chain.bend_max_px, 0.5, 64.0);
    field("rows_min_px", estimate.rows_min_px, 3.0, 480.0);
    field("height_span_min_m", estimate.height_span_min_m, 0.0, 3.0);
    field("column_rms_max_px", estimate.column_rms_max_px, 0.1, 100.0);
    field("lean_max_rad", estimate.lean_max_rad, 0.0, std::numbers::pi / 4.0);
    field("lateral_noise_px", estimate.lateral_noise_px, 0.01, 100.0);
    field("lateral_bias_m", estimate.lateral_bias_m, 1e-4, 1.0);
    field("depth_noise_quanta", estimate.depth_noise_quanta, 0.01, 100.0);
    field("depth_bias_m", estimate.depth_bias_m, 1e-4, 1.0);
    field("round_arc_m", estimate.round.arc_m, 0.02, 1.0);
    field("pole_radius_min_m", estimate.round.pole_radius_min_m, 0.005, 1.0);
    field("pole_radius_max_m", estimate.round.pole_radius_max_m, 0.01, 2.0);
    field("limb_radius_max_m", estimate.round.limb_radius_max_m, 0.01, 3.0);
    field("round_bend_quanta", estimate.round.bend_quanta, 0.01, 10.0);
    field("round_better_ratio", estimate.round.better_ratio, 0.01, 1.0);
  }

  template <class Field>
  void visit_scan_fields(Field&& field) {
    field("scan_height_low_m", scan.height_low_m, 0.0, 3.0);
    field("scan_height_high_m", scan.height_high_m, 0.0, 3.0);
    field("scan_row_step_px", scan.row_step_px, 1, 100);
    field("scan_rows_min_px", scan.rows_min_px, 1.0, 480.0);
    field("crease_side_min_m", crease.side_min_m, 0.01, 2.0);
    field("crease_side_max_m", crease.side_max_m, 0.01, 2.0);
    field("crease_angle_min_rad", crease.angle_min_rad, 0.1, 1.5);
    field("crease_residual_max_quanta", crease.residual_max_quanta, 1e-3, 10.0);
    field("crease_residual_max_m", crease.residual_max_m, 1e-4, 1.0);
    field("crease_bend_min_sigmas", crease.bend_min_sigmas, 0.0, 100.0);
    field("crease_round_better_ratio", crease.round_better_ratio, 0.0, 10.0);
    field("crease_off_scan_max_m", crease.off_scan_max_m, 1e-3, 1.0);
    field("crease_suppress_px", crease.suppress_px, 0.0, 640.0);
    field("crease_position_bias_m", crease.position_bias_m, 1e-4, 1.0);
    field("moving_memory_s", moving.memory_s, 0.0, 10.0);
    field("moving_margin_m", moving.margin_m, 0.01, 2.0);
    field("moving_margin_ratio", moving.margin_ratio, 0.0, 1.0);
    field("moving_unseen_free_m", moving.unseen_free_m, 0.0, 5.0);
    field("moving_width_min_m", moving.width_min_m, 0.0, 2.0);
    field("moving_reach_m", moving.reach_m, 0.0, 2.0);
    field("standing_age_min_s", standing.age_min_s, 0.0, 1.0);
    field("standing_age_max_s", standing.age_max_s, 0.0, 10.0);
    field("standing_age_beside_mover_min_s", standing.age_beside_mover_min_s, 0.0, 1.0);
    field("standing_gap_beside_mover_max_s", standing.gap_beside_mover_max_s, 0.05, 1.0);
    field("standing_age_beside_doubt_min_s", standing.age_beside_doubt_min_s, 0.0, 1.0);
    field("standing_wary_s", standing.wary_s, 0.0, 3600.0);
    field("standing_slow_walk_mps", standing.slow_walk_mps, 0.05, 5.0);
    field("standing_mover_reach_m", standing.mover_reach_m, 0.0, 5.0);
    field("standing_reach_m", standing.reach_m, 0.0, 1.0);
    field("standing_reach_ratio", standing.reach_ratio, 0.0, 1.0);
  }
};

}  // namespace roomwise::landmark
