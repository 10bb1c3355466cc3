#pragma once

namespace roomwise::simulator {

/// The depth camera: projector and camera side by side, matching a pattern of infrared dots.
/// Disparity is counted in quanta of 1/8 px on a grid 640 px wide.
struct DepthSensorParams {
  double focal_px = 585.0;       ///< of the 640 px grid; both images have it when registered
  double baseline_m = 0.075;     ///< the projector sits that far to the right of the camera
  double noise_quanta = 0.36;    ///< sigma, another one in every frame
  double pattern_quanta = 0.30;  ///< sigma of the error that stays at its pixel in all frames
  double ragged_px = 2.0;        ///< how far window matching misplaces an edge, at most
  double near_m = 0.5;           ///< nothing is seen nearer than this
  double far_m = 8.0;            ///< nor beyond
  /// Weakest infrared light that can be matched, as a share of what a white face-on surface 1 m
  /// away returns: reflectance * cos(incidence) / range^2.
  double light_needed_ratio = 0.006;
  double dropout_ratio = 0.001;  ///< share of small patches without reading, at random

  template <class Field>
  void visit_fields(Field&& field) {
    field("depth_focal_px", focal_px, 100.0, 5000.0);
    field("depth_baseline_m", baseline_m, 0.01, 0.5);
    field("depth_noise_quanta", noise_quanta, 0.0, 10.0);
    field("depth_pattern_quanta", pattern_quanta, 0.0, 10.0);
    field("depth_ragged_px", ragged_px, 0.0, 4.0);
    field("depth_near_m", near_m, 0.2, 10.0);
    field("depth_far_m", far_m, 0.3, 20.0);
    field("depth_light_needed_ratio", light_needed_ratio, 0.0, 1.0);
    field("depth_dropout_ratio", dropout_ratio, 0.0, 1.0);
  }

  /// 8 f b: disparity in quanta times depth in metres.
  double quanta_m() const { return 8.0 * focal_px * baseline_m; }
};

/// The colour camera. Light is linear, 1 being white at gain 1.
struct ColorSensorParams {
  double focal_px = 525.0;         ///< of its own image, 640 px wide, when not registered
  double offset_m = 0.025;         ///< it sits that far to the right of the depth camera
  double wanted_ratio = 0.18;      ///< mean brightness that automatic exposure steers to
  double gain_max_ratio = 8.0;     ///< what it can do in the dark
  double gain_step_ratio = 0.04;   ///< largest change from one frame to the next
  double shot_noise_ratio = 1e-4;  ///< variance a unit of light at gain 1
  double read_noise_ratio = 1e-3;  ///< sigma without light at gain 1
  double flicker_ratio = 0.015;    ///< bars of mains light rolling over the rows
  double lamp_roll_ratio = 0.03;   ///< slow swing of the lamps
  double lamp_roll_s = 7.0;        ///< its period

  template <class Field>
  void visit_fields(Field&& field) {
    field("color_focal_px", focal_px, 100.0, 5000.0);
    field("color_offset_m", offset_m, -0.2, 0.2);
    field("color_wanted_ratio", wanted_ratio, 0.01, 0.9);
    field("color_gain_max_ratio", gain_max_ratio, 0.1, 1000.0);
    field("color_gain_step_ratio", gain_step_ratio, 0.0, 1.0);
    field("color_shot_noise_ratio", shot_noise_ratio, 0.0, 0.1);
    field("color_read_noise_ratio", read_noise_ratio, 0.0, 0.1);
    field("color_flicker_ratio", flicker_ratio, 0.0, 0.5);
    field("color_lamp_roll_ratio", lamp_roll_ratio, 0.0, 0.5);
    field("color_lamp_roll_s", lamp_roll_s, 0.1, 3600.0);
  }
};

}  // namespace roomwise::simulator
