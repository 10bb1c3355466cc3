#pragma once

namespace roomwise::safety {

/// What the robot is like; services/safety_svc/params.toml may override any field. Limits that
/// keep people safe are in safety_limits.h and no parameters.
struct SafetyParams {
  double robot_radius_m = 0.17;      ///< about the point between the wheels; Create: 33 cm across
  double margin_m = 0.05;            ///< kept free all round: a cell of the memory, and drift
  double speed_max_mps = 0.5;        ///< a Create's own limit
  double turn_rate_max_radps = 2.0;  ///< faster, depth images smear
  double start_radius_m = 0.45;      ///< whoever starts the robot sees to it that this is clear
  double floor_seen_from_m = 0.0;    ///< nearest floor in view; 0: from the camera's mounting

  template <class Field>
  void visit_fields(Field&& field) {  // name, member, smallest, largest allowed
    field("robot_radius_m", robot_radius_m, 0.05, 0.5);
    field("margin_m", margin_m, 0.03, 0.5);
    field("speed_max_mps", speed_max_mps, 0.01, 0.5);
    field("turn_rate_max_radps", turn_rate_max_radps, 0.05, 4.0);
    field("start_radius_m", start_radius_m, 0.1, 1.0);
    field("floor_seen_from_m", floor_seen_from_m, 0.0, 3.0);
  }
};

}  // namespace roomwise::safety
