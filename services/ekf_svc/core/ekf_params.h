#pragma once
#include <string>

namespace roomwise::ekf {

/// Tuning of the filter; services/ekf_svc/params.toml may override any field.
struct EkfParams {
  /// "invariant": right-invariant EKF. "plain": the textbook EKF, for comparison and teaching.
  std::string filter = "invariant";
  /// "map": builds the map and goes on with a saved one. "localise": a saved map stays as it is.
  std::string mode = "map";
  std::string map_path;        ///< file the map is kept in; empty: none
  int landmark_budget = 2000;  ///< most landmarks in the map; memory for them is taken at start

  double odometry_noise_ratio = 1.0;  ///< factor on the covariance ODOMETRY carries
  /// Learn scale errors of distance and turn, and a steady pull to one side, from landmarks.
  bool self_calibration = true;
  double calibration_sigma_ratio = 0.05;  ///< what to expect of either scale before the first turn
  double calibration_sigma_rad_per_m = 0.02;  ///< and of the pull, turn per distance
  /// And of the distance that speeds which were asked for lose in curves, per turn.
  double calibration_sigma_m_per_rad = 0.05;
  double calibration_drift_ratio =
      0.001;  ///< wander of a scale over a metre of way, per root metre

  /// What to expect of a range's error that depends on where in the view it is seen, in standard
  /// deviations the first sightings claim; 0: of none. Learned if self_calibration is on.
  double range_calibration_sigmas = 0.5;

  double gap_distance_sigma_mps = 0.1;  ///< unseen travel per second without odometry
  double gap_turn_sigma_radps = 0.2;    ///< unseen turn per second without odometry

  double range_bias_m = 0.015;   ///< repeats from frame to frame; added to every range noise
  double lateral_bias_m = 0.01;  ///< the same across the line of sight
  /// A range farther off than this pulls no harder for it; 0: as hard as it is far off. 1 is the
  /// best guard if one range in seven is anything but Gaussian.
  double range_outlier_sigmas = 1.0;

  /// An outline is another corner of a thing when seen from elsewhere: sigma of how far from the
  /// first, a radian of its line of sight; 0: its edges are sharp from everywhere.
  double outline_shift_m_per_rad = 0.08;

  /// Where a landmark that is there is sure to be seen if nothing hides it.
  double view_half_angle_rad = 0.42;
  double view_range_min_m = 0.9;
  double view_range_max_m = 3.2;

  int confirm_sightings = 3;  ///< a thing of unknown identity is mapped when seen so often

  double latency_max_s = 0.5;  ///< LANDMARKS this much older than ODOMETRY are still used in place

  /// Landmarks already mapped are measured again only after this much travel, turn or time...
  double update_travel_m = 0.02;
  double update_turn_rad = 0.0175;
  double update_interval_s = 0.5;
  double parked_after_s = 1.0;  ///< ... and after this long without motion not at all

  template <class Field>
  void visit_fields(Field&& field) {
    field("filter", filter, {"invariant", "plain"});
    field("mode", mode, {"map", "localise"});
    field("map_path", map_path);
    field("landmark_budget", landmark_budget, 1, 8000);
    field("odometry_noise_ratio", odometry_noise_ratio, 1e-3, 1e3);
    field("self_calibration", self_calibration);
    field("calibration_sigma_ratio", calibration_sigma_ratio, 0.0, 0.5);
    field("calibration_sigma_rad_per_m", calibration_sigma_rad_per_m, 0.0, 1.0);
    field("calibration_sigma_m_per_rad", calibration_sigma_m_per_rad, 0.0, 1.0);
    field("calibration_drift_ratio", calibration_drift_ratio, 0.0, 0.1);
    field("range_calibration_sigmas", range_calibration_sigmas, 0.0, 10.0);
    field("gap_distance_sigma_mps", gap_distance_sigma_mps, 0.0, 10.0);
    field("gap_turn_sigma_radps", gap_turn_sigma_radps, 0.0, 10.0);
    field("range_bias_m", range_bias_m, 0.0, 1.0);
    field("lateral_bias_m", lateral_bias_m, 0.0, 1.0);
    field("range_outlier_sigmas", range_outlier_sigmas, 0.0, 100.0);
    field("outline_shift_m_per_rad", outline_shift_m_per_rad, 0.0, 1.0);
    field("view_half_angle_rad", view_half_angle_rad, 0.0, 3.2);
    field("view_range_min_m", view_range_min_m, 0.0, 100.0);
    field("view_range_max_m", view_range_max_m, 0.0, 100.0);
    field("confirm_sightings", confirm_sightings, 1, 100);
    field("latency_max_s", latency_max_s, 0.0, 5.0);
    field("update_travel_m", update_travel_m, 0.0, 1.0);
    field("update_turn_rad", update_turn_rad, 0.0, 1.0);
    field("update_interval_s", update_interval_s, 0.0, 10.0);
    field("parked_after_s", parked_after_s, 0.0, 1e9);
  }
};

}  // namespace roomwise::ekf
