#pragma once

namespace roomwise {

/// Device properties of our Kinect v1 driver beyond OpenNI2's own; openni::Device::getProperty
/// takes the numbers as they are.
enum FreenectProperty : int {
  /// double [rad]: the camera's angle to the horizon, positive looks up. Setting it drives the
  /// motor, which arrives later; at most +-31 degrees.
  kFreenectTilt_rad = 0x52570001,
  /// double[3] [m/s^2]: what the accelerometer feels along the camera's x right, y up, z towards
  /// the
  /// viewer, so that at rest and level it says (0, 9.8, 0).
  kFreenectAcceleration_mps2 = 0x52570002,
};

}  // namespace roomwise
