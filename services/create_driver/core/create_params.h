#pragma once
#include <string>

#include "common/create/encoder_odometry.h"
#include "common/create/open_interface.h"

namespace roomwise::create {

/// Which robot, on which line, and its measures; services/create_driver/params.toml may override
/// any field.
struct CreateParams {
  std::string model = "create2";  ///< "create1": also set wheel_base_m, 0.258 by its makers
  std::string port = "/dev/ttyUSB0";
  std::string baud = "default";  ///< 57600 for a Create 1, 115200 for a Create 2
  /// Modem line that pulls the robot's power-up input (BRC) low to wake it, if one is wired to it.
  std::string wake_line = "none";
  /// "full" switches the robot's own cut-outs for cliffs and lifted wheels off.
  std::string mode = "safe";
  double speed_max_mps = 0.5;  ///< of either wheel; both are scaled so that the curvature stays
  std::string key_path;  ///< of what safety_svc signs with; empty: drive.key in /tmp/roomwise-UID
  std::string angle_rounding = "truncate";  ///< Create 1: what it does with parts of a degree
  WheelGeometry wheels;                     ///< scripts/calibrate measures the first four

  template <class Field>
  void visit_fields(Field&& field) {
    field("model", model, {"create1", "create2"});
    field("port", port);
    field("baud", baud, {"default", "19200", "57600", "115200"});
    field("wake_line", wake_line, {"none", "rts", "dtr"});
    field("mode", mode, {"safe", "full"});
    field("speed_max_mps", speed_max_mps, 0.01, 0.5);
    field("key_path", key_path);
    field("angle_rounding", angle_rounding, {"truncate", "carry"});
    field("wheel_base_m", wheels.wheel_base_m, 0.1, 0.5);
    field("wheel_diameter_m", wheels.wheel_diameter_m, 0.03, 0.2);
    field("left_scale_ratio", wheels.left_scale_ratio, 0.8, 1.25);
    field("right_scale_ratio", wheels.right_scale_ratio, 0.8, 1.25);
    field("wheel_noise_m2_per_m", wheels.wheel_noise_m2_per_m, 1e-9, 1e-2);
    field("turn_noise_rad2_per_rad", wheels.turn_noise_rad2_per_rad, 0.0, 1e-1);
  }
};

inline Model model_of(const CreateParams& params) {
  return params.model == "create1" ? Model::kCreate1 : Model::kCreate2;
}

/// Bits a second on the line.
inline int baud_of(const CreateParams& params) {
  if (params.baud == "default") return model_of(params) == Model::kCreate1 ? 57600 : 115200;
  return params.baud == "19200" ? 19200 : params.baud == "57600" ? 57600 : 115200;
}

}  // namespace roomwise::create
