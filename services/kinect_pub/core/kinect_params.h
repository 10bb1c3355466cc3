#pragma once
#include <string>

namespace roomwise::kinect {

/// Settings of kinect_pub; services/kinect_pub/params.toml may override any field.
struct KinectParams {
  /// Which camera: empty for the first there is, an OpenNI2 URI, or a recording (path ending in
  /// .oni).
  std::string device;
  std::string resolution = "640x480";  ///< or "320x240"; of depth and colour, at 30 Hz
  bool use_color = true;               ///< false: depth alone
  bool register_depth = true;          ///< depth pixels on the colour image's pixels, if it can
  std::string depth_words = "depth";   ///< or "depth_and_player": 13 bits above a player index of 3
  int depth_max_mm = 10000;            ///< larger readings (65535 is -1) are none
  double pair_tolerance_s = 0.017;     ///< half a frame: depth and colour farther apart are no pair
  double silence_max_s = 1.0;          ///< no pair for so long means that the device is lost
  double start_max_s = 5.0;            ///< the same before its first pair: sensors start slowly
  double clock_window_s = 10.0;        ///< over which the smallest delay is looked for
  double exposure_delay_s = 0.0;       ///< least time from mid-exposure to arrival, if measured
  bool loop_recording = false;         ///< play a recording again and again
  bool recording_is_registered = false;  ///< a recording does not say
  std::string depth_encoding = "pdz16";  ///< or "raw16"; frames with players are always player16
  std::string color_encoding = "jpeg";   ///< or "rgb8"
  int jpeg_quality = 85;
  bool use_own_intrinsics = false;  ///< false: from the fields of view the device states
  double depth_fx_px = 575.8;       ///< own intrinsics, of the images as published
  double depth_fy_px = 575.8;
  double depth_cx_px = 320.0;
  double depth_cy_px = 240.0;
  double color_fx_px = 525.0;
  double color_fy_px = 525.0;
  double color_cx_px = 320.0;
  double color_cy_px = 240.0;
  double camera_x_m = 0.0;        ///< forward of the point between the wheels
  double camera_y_m = 0.0;        ///< left of it
  double camera_height_m = 0.3;   ///< above the floor
  double camera_yaw_rad = 0.0;    ///< positive looks left
  double camera_pitch_rad = 0.0;  ///< positive looks down
  double camera_roll_rad = 0.0;   ///< positive leans to its right

  template <class Field>
  void visit_fields(Field&& field) {  // name, member, smallest, largest allowed
    field("device", device);
    field("resolution", resolution, {"640x480", "320x240"});
    field("use_color", use_color);
    field("register_depth", register_depth);
    field("depth_words", depth_words, {"depth", "depth_and_player"});
    field("depth_max_mm", depth_max_mm, 1, 65534);
    field("pair_tolerance_s", pair_tolerance_s, 0.0, 1.0);
    field("silence_max_s", silence_max_s, 0.1, 60.0);
    field("start_max_s", start_max_s, 0.1, 60.0);
    field("clock_window_s", clock_window_s, 0.1, 3600.0);
    field("exposure_delay_s", exposure_delay_s, 0.0, 1.0);
    field("loop_recording", loop_recording);
    field("recording_is_registered", recording_is_registered);
    field("depth_encoding", depth_encoding, {"pdz16", "raw16"});
    field("color_encoding", color_encoding, {"jpeg", "rgb8"});
    field("jpeg_quality", jpeg_quality, 1, 100);
    field("use_own_intrinsics", use_own_intrinsics);
    field("depth_fx_px", depth_fx_px, 10.0, 10000.0);
    field("depth_fy_px", depth_fy_px, 10.0, 10000.0);
    field("depth_cx_px", depth_cx_px, -4096.0, 8192.0);
    field("depth_cy_px", depth_cy_px, -4096.0, 8192.0);
    field("color_fx_px", color_fx_px, 10.0, 10000.0);
    field("color_fy_px", color_fy_px, 10.0, 10000.0);
    field("color_cx_px", color_cx_px, -4096.0, 8192.0);
    field("color_cy_px", color_cy_px, -4096.0, 8192.0);
    field("camera_x_m", camera_x_m, -2.0, 2.0);
    field("camera_y_m", camera_y_m, -2.0, 2.0);
    field("camera_height_m", camera_height_m, 0.0, 3.0);
    field("camera_yaw_rad", camera_yaw_rad, -3.15, 3.15);
    field("camera_pitch_rad", camera_pitch_rad, -1.6, 1.6);
    field("camera_roll_rad", camera_roll_rad, -3.15, 3.15);
  }
};

}  // namespace roomwise::kinect
