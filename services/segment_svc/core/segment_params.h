#pragma once
#include <string>

namespace roomwise::segment {

/// Tuning of segment_svc; services/segment_svc/params.toml may override any field.
struct SegmentParams {
  std::string model = "fused";  ///< how pixels are labelled
  std::string model_path;       ///< file of what was taught; empty: kept in memory only
  std::string training_statistics =
      "average";                  ///< how the grey Gaussians' mean and sigma are found
  bool color_needs_depth = true;  ///< colour alone does not label a pixel without a reading

  double baseline_m = 0.075;        ///< between projector and camera; Kinect and PrimeSense: 7.5 cm
  double range_max_m = 6.0;         ///< farther readings are unknown
  double floor_tolerance_m = 0.02;  ///< a floor pixel's height may be off by this and its noise
  double drop_off_depth_m = 0.10;   ///< floor this far below the floor is an edge to fall off
  double camera_height_min_m = 0.10;  ///< where the floor is looked for
  double camera_height_max_m = 2.00;
  double tilt_max_rad = 0.26;  ///< floor normal against the mounting: 15 degrees
  int floor_inliers_min = 80;  ///< of the grid's points; fewer: the plane is not trusted

  double robot_width_m = 0.34;      ///< Create: 33 cm
  double robot_height_m = 0.60;     ///< what is higher does not stop the robot
  double corridor_margin_m = 0.05;  ///< each side of the swept corridor
  double corridor_length_m = 2.5;   ///< unknown pixels are counted up to here
  double safe_distance_m = 0.20;    ///< the thesis's safe distance

  template <class Field>
  void visit_fields(Field&& field) {
    field("model", model, {"geometry", "gaussian", "mixture", "edges", "fused"});
    field("model_path", model_path);
    field("training_statistics", training_statistics, {"average", "threshold"});
    field("color_needs_depth", color_needs_depth);
    field("baseline_m", baseline_m, 0.01, 0.5);
    field("range_max_m", range_max_m, 1.0, 10.0);
    field("floor_tolerance_m", floor_tolerance_m, 0.005, 0.2);
    field("drop_off_depth_m", drop_off_depth_m, 0.03, 1.0);
    field("camera_height_min_m", camera_height_min_m, 0.05, 3.0);
    field("camera_height_max_m", camera_height_max_m, 0.05, 3.0);
    field("tilt_max_rad", tilt_max_rad, 0.0, 0.7);
    field("floor_inliers_min", floor_inliers_min, 3, 10000);
    field("robot_width_m", robot_width_m, 0.05, 2.0);
    field("robot_height_m", robot_height_m, 0.05, 3.0);
    field("corridor_margin_m", corridor_margin_m, 0.0, 1.0);
    field("corridor_length_m", corridor_length_m, 0.2, 10.0);
    field("safe_distance_m", safe_distance_m, 0.0, 5.0);
  }
};

}  // namespace roomwise::segment
