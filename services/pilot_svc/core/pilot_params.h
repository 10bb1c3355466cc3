#pragma once

namespace roomwise::pilot {

/// Tuning of pilot_svc; services/pilot_svc/params.toml may override any field.
struct PilotParams {
  double speed_mps = 0.25;        ///< when the goal names none, and at most
  double turn_rate_radps = 1.0;   ///< at most
  double turn_gain_hz = 2.0;      ///< turn rate per radian off course
  double turn_on_spot_rad = 0.6;  ///< farther off course than this it does not drive
  double slow_down_hz = 0.8;      ///< speed per metre of free way

  double robot_radius_m = 0.17;  ///< Create
  double margin_m = 0.10;        ///< kept free beside the body where there is room
  double margin_tight_m = 0.05;  ///< kept free where there is none

  double reach_m = 3.0;            ///< free range beyond this is not looked at
  double floor_seen_from_m = 0.8;  ///< nearer than this the camera does not see the floor
  double blind_m = 1.0;            ///< ways never seen count as free so far, to be looked at
  double memory_s = 60.0;          ///< how long what was seen to stand somewhere is remembered
  double near_memory_s = 20.0;     ///< the same for what stands nearer than floor is seen
  double guess_memory_s = 5.0;     ///< the same for what is only known to be near
  double refusal_memory_s = 20.0;  ///< the same for where safety_svc lets it not go

  double way_min_m = 0.45;        ///< a direction with less free way is not taken
  double turn_cost_ratio = 0.35;  ///< of a direction's score, for turning half round
  double keep_bonus_ratio = 0.5;  ///< hysteresis: what another direction must be better by
  double visit_cost_ratio = 1.0;  ///< for a place visited just now
  double visit_fades_s = 120.0;   ///< visits count less by a factor e after this

  double look_every_m = 0.25;   ///< circle: turns toward the object after that way ...
  double look_every_rad = 0.5;  ///< ... or that turn
  double look_turn_rad = 0.9;   ///< by this much
  double look_s = 0.25;         ///< and stays so long

  double reached_m = 0.10;     ///< go_to: near enough
  double no_nearer_s = 60.0;   ///< go_to: no nearer for that long is NO_WAY
  double stuck_after_s = 4.0;  ///< asked to move, but did not
  double back_off_m = 0.12;
  int recoveries_max = 6;  ///< without getting a metre away from where they began

  double odometry_age_max_s = 0.4;
  double segments_age_max_s = 0.5;
  double pose_age_max_s = 1.0;
  double wait_max_s = 10.0;  ///< without an input it gives up after that long
  double request_life_s = 0.2;

  template <class Field>
  void visit_fields(Field&& field) {
    field("speed_mps", speed_mps, 0.02, 0.5);
    field("turn_rate_radps", turn_rate_radps, 0.1, 3.0);
    field("turn_gain_hz", turn_gain_hz, 0.1, 10.0);
    field("turn_on_spot_rad", turn_on_spot_rad, 0.1, 1.5);
    field("slow_down_hz", slow_down_hz, 0.1, 10.0);
    field("robot_radius_m", robot_radius_m, 0.05, 1.0);
    field("margin_m", margin_m, 0.0, 0.5);
    field("margin_tight_m", margin_tight_m, 0.0, 0.5);
    field("reach_m", reach_m, 1.0, 3.0);
    field("floor_seen_from_m", floor_seen_from_m, 0.1, 2.0);
    field("blind_m", blind_m, 0.1, 2.0);
    field("memory_s", memory_s, 1.0, 600.0);
    field("near_memory_s", near_memory_s, 0.1, 600.0);
    field("guess_memory_s", guess_memory_s, 0.1, 600.0);
    field("refusal_memory_s", refusal_memory_s, 0.1, 600.0);
    field("way_min_m", way_min_m, 0.1, 2.0);
    field("turn_cost_ratio", turn_cost_ratio, 0.0, 5.0);
    field("keep_bonus_ratio", keep_bonus_ratio, 0.0, 5.0);
    field("visit_cost_ratio", visit_cost_ratio, 0.0, 5.0);
    field("visit_fades_s", visit_fades_s, 1.0, 3600.0);
    field("look_every_m", look_every_m, 0.1, 10.0);
    field("look_every_rad", look_every_rad, 0.1, 10.0);
    field("look_turn_rad", look_turn_rad, 0.0, 1.5);
    field("look_s", look_s, 0.0, 5.0);
    field("reached_m", reached_m, 0.02, 1.0);
    field("no_nearer_s", no_nearer_s, 1.0, 600.0);
    field("stuck_after_s", stuck_after_s, 0.5, 60.0);
    field("back_off_m", back_off_m, 0.0, 0.5);
    field("recoveries_max", recoveries_max, 0, 100);
    field("odometry_age_max_s", odometry_age_max_s, 0.05, 5.0);
    field("segments_age_max_s", segments_age_max_s, 0.05, 5.0);
    field("pose_age_max_s", pose_age_max_s, 0.05, 10.0);
    field("wait_max_s", wait_max_s, 0.5, 600.0);
    field("request_life_s", request_life_s, 0.06, 1.0);
  }
};

}  // namespace roomwise::pilot
