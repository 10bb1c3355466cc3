#include "tests/lcmtypes/examples.h"

namespace roomwise {
namespace {

constexpr std::int64_t kUtime = 1'700'000'000'123'456;

landmark_observation_t observation(std::int32_t identity, double range_m) {
  return {.identity = identity,
          .kind = landmark_observation_t::KIND_EDGE_LEFT,
          .moving = 1,
          .range_m = range_m,
          .bearing_rad = -0.25,
          .covariance_range_range_m2 = 0.0004,
          .covariance_range_bearing_m_rad = -0.00001,
          .covariance_bearing_bearing_rad2 = 0.0001,
          .height_low_m = 0.125,
          .height_high_m = 1.75,
          .step_m = 0.5,
          .chroma_red_log = 0.3,
          .chroma_blue_log = -0.4,
          .chroma_variance_log2 = 0.01,
          .score_ratio = 0.875,
          .rows = 96,
          .pixel_u_px = 321.5,
          .pixel_v_top_px = 40.5,
          .pixel_v_bottom_px = 136.5};
}

map_landmark_t map_landmark(std::int64_t map_id) {
  return {.map_id = map_id,
          .identity = -1,
          .kind = landmark_observation_t::KIND_POLE,
          .map_x_m = 1.5,
          .map_y_m = -2.5,
          .covariance_x_x_m2 = 0.001,
          .covariance_x_y_m2 = -0.0002,
          .covariance_y_y_m2 = 0.003,
          .chroma_red_log = 0.5,
          .chroma_blue_log = -0.6,
          .chroma_variance_log2 = 0.02,
          .times_seen = 17};
}

}  // namespace

template <>
named_count_t example() {
  return {.name = "not_finite", .count = 3};
}

template <>
channel_health_t example() {
  return {.channel = "ODOMETRY",
          .received = 101,
          .published = 102,
          .missed = 103,
          .undecodable = 104,
          .skipped = 105,
          .restarts = 106,
          .age_s = 0.015,
          .handler_mean_s = 0.001,
          .handler_max_s = 0.002};
}

template <>
device_status_t example() {
  return {.utime = kUtime,
          .seq = 8,
          .state = device_status_t::STATE_LOST,
          .backend = "openni2 2.2.0.33",
          .device_name = "Roomwise Simulated Kinect",
          .device_uri = "roomwise-sim:///run/kinect",
          .device_serial = "sim-1",
          .depth_width_px = 640,
          .depth_height_px = 480,
          .color_width_px = 320,
          .color_height_px = 240,
          .registration_asked = 1,
          .registration_in_force = 0,
          .mirrored_by_device = 1,
          .frame_rate_hz = 29.5,
          .encode_mean_s = 0.0035,
          .encode_max_s = 0.009,
          .frames_published = 1001,
          .frames_dropped = 1002,
          .depth_unpaired = 1003,
          .color_unpaired = 1004,
          .frames_malformed = 1005,
          .device_losses = 1006,
          .reconnects = 1007,
          .clock_restarts = 1008,
          .clock_offset_us = kUtime - 5,
          .last_error = "went away"};
}

template <>
health_t example() {
  return {.utime = kUtime,
          .seq = 7,
          .service = "ekf_svc",
          .uptime_s = 12.5,
          .cpu_ratio = 0.25,
          .memory_bytes = 33'554'432,
          .channel_count = 2,
          .channels = {example<channel_health_t>(), example<channel_health_t>()},
          .counter_count = 1,
          .counters = {example<named_count_t>()},
          .last_error = "nothing yet"};
}

template <>
kinect_frame_t example() {
  return {.utime = kUtime,
          .seq = 8,
          .device_time_us = 33'333,
          .depth_encoding = kinect_frame_t::DEPTH_RAW16,
          .depth_registered = 1,
          .depth_width_px = 2,
          .depth_height_px = 1,
          .depth_unit_m = 0.001,
          .depth_fx_px = 585.0,
          .depth_fy_px = 586.0,
          .depth_cx_px = 319.5,
          .depth_cy_px = 239.5,
          .depth_size = 4,
          .depth_data = {0xE8, 0x03, 0xD0, 0x07},
          .color_encoding = kinect_frame_t::COLOR_RGB8,
          .color_width_px = 1,
          .color_height_px = 1,
          .color_fx_px = 525.0,
          .color_fy_px = 526.0,
          .color_cx_px = 320.5,
          .color_cy_px = 240.5,
          .color_size = 3,
          .color_data = {10, 20, 30},
          .T_robot_camera_translation_m = {0.1, 0.02, 0.3},
          .T_robot_camera_quat = {0.5, -0.5, 0.5, -0.5}};
}

template <>
landmark_observation_t example() {
  return observation(5, 2.0);
}

template <>
landmark_list_t example() {
  return {.utime = kUtime,
          .seq = 9,
          .frame_seq = 8,
          .width_px = 640,
          .height_px = 480,
          .count = 2,
          .landmarks = {observation(5, 2.0), observation(-1, 3.5)},
          .edge_count = 1000,
          .edge_listed = 2,
          .edge_u_px = {320, 321},
          .edge_v_px = {100, 101},
          .scan_count = 2,
          .scan_x_m = {1.5F, 2.5F},
          .scan_y_m = {0.5F, -0.25F},
          .alpha_ratio = 0.25,
          .beta_ratio = 0.75,
          .threshold_mm_per_px = 100.0,
          .threshold_quanta = 3.0,
          .range_min_m = 1.22,
          .range_max_m = 3.81,
          .rejection_count = 1,
          .rejections = {example<named_count_t>()}};
}

template <>
map_landmark_t example() {
  return map_landmark(11);
}

template <>
landmark_map_t example() {
  return {.utime = kUtime,
          .seq = 10,
          .map_count = 2,
          .map_landmarks = {map_landmark(11), map_landmark(12)}};
}

template <>
params_t example() {
  return {.utime = kUtime, .seq = 12, .service = "ekf_svc", .toml = "range_noise_m = 0.05\n"};
}

template <>
pose_t example() {
  return {.utime = kUtime,
          .seq = 13,
          .x_m = 1.0,
          .y_m = 2.0,
          .heading_rad = -3.0,
          .covariance_x_x_m2 = 0.01,
          .covariance_x_y_m2 = 0.001,
          .covariance_y_y_m2 = 0.02,
          .covariance_x_heading_m_rad = 0.002,
          .covariance_y_heading_m_rad = -0.003,
          .covariance_heading_heading_rad2 = 0.004,
          .nis_ratio = 0.9,
          .nis_dof = 4,
          .landmarks_in_map = 21,
          .landmarks_seen = 5,
          .landmarks_matched = 3,
          .landmarks_added = 1,
          .landmarks_rejected = 2,
          .landmarks_merged = 6,
          .landmark_noise_ratio = 1.5,
          .distance_scale_ratio = 0.98,
          .turn_scale_ratio = 1.01,
          .turn_per_distance_rad_per_m = -0.005,
          .distance_scale_sigma_ratio = 0.006,
          .turn_scale_sigma_ratio = 0.007,
          .turn_per_distance_sigma_rad_per_m = 0.008,
          .state = pose_t::STATE_TRACKING};
}

template <>
training_rectangle_t example() {
  return {.label = segmentation_t::LABEL_ACCESSIBLE,
          .left_px = 10,
          .top_px = 300,
          .width_px = 200,
          .height_px = 100};
}

template <>
segment_training_t example() {
  return {.utime = kUtime,
          .seq = 14,
          .train_frame_utime = kUtime - 500'000,
          .rectangle_count = 2,
          .rectangles = {example<training_rectangle_t>(), example<training_rectangle_t>()}};
}

template <>
segmentation_t example() {
  return {.utime = kUtime,
          .seq = 15,
          .frame_seq = 8,
          .label_width_px = 3,
          .label_height_px = 1,
          .label_encoding = segmentation_t::ENCODING_RAW8,
          .label_size = 3,
          .label_data = {0, 200, 255},
          .class_count = 2,
          .class_label = {segmentation_t::LABEL_OBSTACLE, segmentation_t::LABEL_ACCESSIBLE},
          .class_fraction_ratio = {0.25, 0.5},
          .class_mean_distance_m = {1.5, 2.5},
          .floor_normal_ratio = {0.0, -1.0, 0.125},
          .floor_height_m = 0.31,
          .camera_pitch_rad = 0.2,
          .camera_roll_rad = -0.01,
          .floor_inliers = 5000,
          .floor_trusted = 1,
          .bin_count = 2,
          .bin_first_bearing_rad = -0.5,
          .bin_step_rad = 0.0625,
          .free_range_m = {1.1, 2.2},
          .unknown_ratio = {0.1, 0.2},
          .obstacle_range_m = {1.15, 0.0},
          .mean_distance_m = 2.1,
          .safe_distance_m = 0.2,
          .near_distance_m = 0.9,
          .corridor_unknown_ratio = 0.05,
          .model = "fused"};
}

template <>
true_landmark_t example() {
  return {.identity = 6,
          .kind = landmark_observation_t::KIND_FIDUCIAL,
          .true_x_m = 4.5,
          .true_y_m = -5.5};
}

template <>
truth_t example() {
  return {.utime = kUtime,
          .seq = 16,
          .true_x_m = 0.5,
          .true_y_m = 0.25,
          .true_heading_rad = 1.5,
          .has_camera_pose = 1,
          .T_world_camera_translation_m = {0.7, 0.8, 0.9},
          .T_world_camera_quat = {0.5, 0.5, -0.5, -0.5},
          .contacts = 1,
          .landmark_count = 1,
          .true_landmarks = {example<true_landmark_t>()}};
}

}  // namespace roomwise
