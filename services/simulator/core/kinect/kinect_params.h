#pragma once

namespace roomwise::simulator {

/// The depth camera: projector and camera side by side, matching a pattern of infrared dots.
/// Disparity is counted in quanta of 1/8 px on a grid 640 px wide.
struct DepthSensorParams {
  double depth_focal_px = 585.0;  ///< of the 640 px grid, and of depth images as they are measured
  double projector_m = 0.075;     ///< the projector sits that far to the right of the camera
  double depth_noise_quanta = 0.34;    ///< sigma, another one in every frame
  double depth_pattern_quanta = 0.40;  ///< sigma of the error that stays at its pixel in all frames
  double ragged_px = 2.0;              ///< how far window matching misplaces an edge, at most
  double depth_near_m = 0.5;           ///< nothing is seen nearer than this
  double depth_far_m = 8.0;            ///< nor beyond
  /// Weakest infrared light that can be matched, as a share of what a white face-on surface 1 m
  /// away returns: reflectance * cos(incidence) / range^2.
  double light_needed_ratio = 0.006;
  double depth_dropout_ratio = 0.001;  ///< share of small patches without reading, at random

  template <class Field>
  void visit_fields(Field&& field) {
    field("depth_focal_px", depth_focal_px, 100.0, 5000.0);
    field("projector_m", projector_m, 0.01, 0.5);
    field("depth_noise_quanta", depth_noise_quanta, 0.0, 10.0);
    field("depth_pattern_quanta", depth_pattern_quanta, 0.0, 10.0);
    field("ragged_px", ragged_px, 0.0, 4.0);
    field("depth_near_m", depth_near_m, 0.2, 10.0);
    field("depth_far_m", depth_far_m, 0.3, 20.0);
    field("light_needed_ratio", light_needed_ratio, 0.0, 1.0);
    field("depth_dropout_ratio", depth_dropout_ratio, 0.0, 1.0);
  }

  /// 8 f b: disparity in quanta times depth in metres.
  double quanta_m() const { return 8.0 * depth_focal_px * projector_m; }
};

/// The colour camera. Light is linear, 1 being white at gain 1.
struct ColorSensorParams {
  double color_focal_px = 525.0;        ///< of images 640 px wide, and of depth registered to them
  double color_offset_m = 0.025;        ///< it sits that far to the right of the depth camera
  double color_wanted_ratio = 0.18;     ///< mean brightness that automatic exposure steers to
  double color_gain_max_ratio = 8.0;    ///< what it can do in the dark
  double color_gain_step_ratio = 0.04;  ///< largest change from one frame to the next
  double color_noise_levels = 1.6;      ///< sigma of a level, 0 to 255, at gain 1
  double color_flicker_ratio = 0.015;   ///< bars of mains light rolling over the rows
  double lamp_roll_ratio = 0.03;        ///< slow swing of the lamps
  double lamp_roll_s = 7.0;             ///< its period

  template <class Field>
  void visit_fields(Field&& field) {
    field("color_focal_px", color_focal_px, 100.0, 5000.0);
    field("color_offset_m", color_offset_m, -0.2, 0.2);
    field("color_wanted_ratio", color_wanted_ratio, 0.01, 0.9);
    field("color_gain_max_ratio", color_gain_max_ratio, 0.1, 1000.0);
    field("color_gain_step_ratio", color_gain_step_ratio, 0.0, 1.0);
    field("color_noise_levels", color_noise_levels, 0.0, 50.0);
    field("color_flicker_ratio", color_flicker_ratio, 0.0, 0.5);
    field("lamp_roll_ratio", lamp_roll_ratio, 0.0, 0.5);
    field("lamp_roll_s", lamp_roll_s, 0.1, 3600.0);
  }
};

}  // namespace roomwise::simulator
