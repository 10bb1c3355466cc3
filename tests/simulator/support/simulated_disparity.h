#pragma once
#include <vector>

#include "services/simulator/render/simulated_kinect.h"
#include "tests/simulator/support/disparity_statistics.h"
#include "tests/simulator/support/plain_scene.h"

namespace roomwise::simulator {

/// Disparities of successive frames of a resting camera.
inline std::vector<DisparityImage> disparities(const Scene& scene,
                                               const Eigen::Isometry3d& T_world_camera) {
  constexpr int kFrames = 4;
  SimulatedKinect kinect(scene, {}, {}, 1);
  std::vector<DisparityImage> images;
  RgbdFrame frame;
  for (int i = 0; i < kFrames; ++i) {
    kinect.capture(T_world_camera, i / 30.0, i, {}, frame);
    images.push_back({frame.depth.width_px,
                      frame.depth.height_px,
                      {kinect.quanta().begin(), kinect.quanta().end()}});
  }
  return images;
}

/// Of a floor seen from 1.2 m up, as in recordings made by hand.
inline std::vector<DisparityImage> disparities_of_floor() {
  PlainScene plain;
  plain.put_floor();
  return disparities(plain.scene(), camera_pose(1.2, 0.6));
}

/// Of a wall 2.5 m ahead, a little askew.
inline std::vector<DisparityImage> disparities_of_wall() {
  PlainScene plain;
  plain.put_wall(2.5);
  return disparities(plain.scene(),
                     Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) * camera_pose(1.0, 0.1));
}

}  // namespace roomwise::simulator
