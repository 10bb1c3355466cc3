#pragma once
#include <string>
#include <vector>

#include "services/simulator/core/create/open_interface_params.h"
#include "services/simulator/core/kinect/kinect_params.h"
#include "services/simulator/core/robot_params.h"

namespace roomwise::simulator {

/// The world and the Create in it; services/simulator/params.toml may override any field.
struct SimulatorParams {
  std::string scenario = "living_room";  ///< of services/simulator/scenarios, or a .toml file
  int seed = 1;
  /// What goes wrong besides what the scenario says, as core/create/fault.h reads it.
  std::vector<std::string> fault;
  std::string create_port;     ///< link to the serial port; empty: /tmp/roomwise-UID/create
  std::string kinect_door;     ///< where the Kinect's frames go; empty: what its driver looks for
  double battery_ratio = 0.9;  ///< charge at the start
  double catch_up_s = 60.0;    ///< how late the world may be and still live through every step
  RobotParams robot;
  OpenInterfaceParams interface;
  std::string camera_size = "640x480";  ///< of recorded drives; live, the camera's reader chooses
  bool camera_registered = true;        ///< the same
  bool true_labels = false;             ///< recorded drives: a true label image with every frame
  DepthSensorParams depth;
  ColorSensorParams color;

  template <class Field>
  void visit_fields(Field&& field) {
    field("scenario", scenario);
    field("seed", seed, 0, 2147483647);
    field("fault", fault);
    field("create_port", create_port);
    field("kinect_door", kinect_door);
    field("battery_ratio", battery_ratio, 0.0, 1.0);
    field("catch_up_s", catch_up_s, 0.1, 3600.0);

    field("robot_radius_m", robot.radius_m, 0.05, 0.5);
    field("top_speed_mps", robot.top_speed_mps, 0.05, 1.0);
    field("acceleration_mps2", robot.acceleration_mps2, 0.1, 100.0);
    field("braking_mps2", robot.braking_mps2, 0.1, 100.0);
    field("left_wheel_ratio", robot.left_wheel_ratio, 0.5, 2.0);
    field("right_wheel_ratio", robot.right_wheel_ratio, 0.5, 2.0);
    field("wheel_base_ratio", robot.wheel_base_ratio, 0.5, 2.0);
    field("slip_ratio", robot.slip_ratio, 0.0, 0.5);
    field("slip_m2_per_m", robot.slip_m2_per_m, 0.0, 1e-3);
    field("stall_after_s", robot.stall_after_s, 0.0, 10.0);

    field("create_model", interface.model, {"create1", "create2"});
    field("odometry_rounding", interface.odometry_rounding, {"truncate", "carry"});
    field("create_firmware", interface.firmware, {"3.7.7", "3.4.0", "3.2.6"});
    field("mode_byte", interface.mode_byte, {"standard", "plus_one"});
    field("stream_checksum", interface.checksum, {"with_header", "without_header"});
    field("locks_after_trip", interface.locks_after_trip);
    field("mode_settle_s", interface.mode_settle_s, 0.0, 1.0);
    field("boot_s", interface.boot_s, 0.2, 60.0);
    field("sleep_after_s", interface.sleep_after_s, 1.0, 86400.0);

    field("camera_size", camera_size, {"640x480", "320x240"});
    field("camera_registered", camera_registered);
    field("true_labels", true_labels);
    depth.visit_fields(field);
    color.visit_fields(field);
  }
};

}  // namespace roomwise::simulator
